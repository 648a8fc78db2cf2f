// SPDX-License-Identifier: Apache-2.0
#include "core/cloud_files.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

TEST(CloudFiles, AreFilesScanFoldersAndFoldersOfTiles) {
  const TemporaryFolder folder;
  const auto scan = folder.write("scan/cloud.pcd", "");
  folder.write("scan/cloud.ply", "");
  const auto second = folder.write("tiles/b.LAS", "");
  const auto first = folder.write("tiles/a.xyz", "");
  folder.write("tiles/README.txt", "");
  const auto single = folder.write("single.csv", "");
  EXPECT_THAT(cloud_files_of({folder.path() / "tiles", single, folder.path() / "scan"}),
              ElementsAre(first, second, single, scan));
  EXPECT_EQ(CloudFiles(single).name(), single.string());
  EXPECT_EQ(CloudFiles({first, second, single}).name(), first.string() + " and 2 more");
}

TEST(CloudFiles, RefusesWhatIsNone) {
  const TemporaryFolder folder;
  const auto file = folder.write("tiles/a.xyz", "");
  folder.write("notes/README.txt", "");
  const auto refusal = [](const std::vector<std::filesystem::path>& paths) {
    return message_of<InputError>([&] { cloud_files_of(paths); });
  };
  EXPECT_THAT(refusal({folder.path() / "absent.las"}), HasSubstr("absent.las: no such file"));
  EXPECT_THAT(refusal({folder.path() / "notes"}), HasSubstr("neither a scan folder"));
  EXPECT_THAT(refusal({file, folder.path() / "tiles"}), HasSubstr("a.xyz: is given twice"));
}

}  // namespace
}  // namespace plotscan
