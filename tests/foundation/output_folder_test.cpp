// SPDX-License-Identifier: Apache-2.0
#include "core/output_folder.h"

#include "temporary_folder.h"

#include "core/error.h"

namespace plotscan {
namespace {
namespace fs = std::filesystem;

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(OutputFolder, AppearsOnlyWhenCommitted) {
  const testing::TemporaryFolder folder;
  {
    const OutputFolder abandoned(folder.path() / "out", false);
    std::ofstream(abandoned.path() / "file") << "x";
  }
  EXPECT_EQ(entries(folder.path()), 0u);
  OutputFolder kept(folder.path() / "deep" / "out/", false);
  std::ofstream(kept.path() / "file") << "x";
  EXPECT_FALSE(fs::exists(folder.path() / "deep/out"));
  kept.commit();
  EXPECT_TRUE(fs::exists(folder.path() / "deep/out/file"));
  EXPECT_EQ(entries(folder.path() / "deep"), 1u);
}

TEST(OutputFolder, NeverReplacesWhatIsNotOurs) {
  const testing::TemporaryFolder folder;
  folder.write("foreign/data", "precious");
  EXPECT_THROW(OutputFolder(folder.path() / "foreign", true), InputError);
  EXPECT_THROW(OutputFolder(folder.write("file", ""), true), InputError);
  folder.write("ours/manifest.json", "{}");
  EXPECT_THROW(OutputFolder(folder.path() / "ours", false), InputError);
  OutputFolder replaced(folder.path() / "ours", true);
  EXPECT_TRUE(fs::exists(folder.path() / "ours/manifest.json"));
  replaced.commit();
  EXPECT_FALSE(fs::exists(folder.path() / "ours/manifest.json"));
}

}  // namespace
}  // namespace plotscan
