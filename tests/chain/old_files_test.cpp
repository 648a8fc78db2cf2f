// SPDX-License-Identifier: Apache-2.0
// What earlier versions wrote is read by this one, and what a later one writes is refused by name.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/format_version.h"
#include "small_farm.h"

namespace plotscan::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class OldFiles : public CommandsInAFolder {
 protected:
  OldFiles() {
    fs::copy(PLOTSCAN_SOURCE_DIR "/tests/fixtures/v0.1.0", folder_.path(),
             fs::copy_options::recursive);
  }
};

TEST_F(OldFiles, AreReadByEveryCommand) {
  EXPECT_THAT(succeed("farmgen info farm --json").output, HasSubstr("\"plots\""));
  succeed("lidarsim fly farm --flight scan/trajectory.csv -o flown");
  succeed("lidarsim convert scan scan.las");
  succeed("estimator info scan");
  succeed("estimator run scan --boxes estimate/plots.geojson -o again");
  succeed("estimator report estimate --truth farm -o page.html");
  const auto scores =
      nlohmann::json::parse(succeed("estimator score estimate --truth farm --json").output);
  const auto before = nlohmann::json::parse(read_text(folder_.path() / "score/scores.json"));
  for (const auto& [name, value] : before["boxes"].items())
    EXPECT_NEAR(scores["boxes"][name].get<double>(), value.get<double>(), 1e-12) << name;
  EXPECT_EQ(scores["heights"].size(), before["heights"].size());
  succeed("farmgen generate two_plots.yaml --seed 7 -o farm --force");
}

TEST_F(OldFiles, OfLaterVersionsAreRefusedByName) {
  for (const char* name : {"farm", "scan", "estimate"}) {
    const fs::path file = folder_.path() / name / "manifest.json";
    auto manifest = nlohmann::json::parse(read_text(file));
    manifest["format"] = kFormat + 1;
    std::ofstream(file) << manifest;
  }
  for (const char* command : {"farmgen info farm", "lidarsim convert scan scan.las",
                              "estimator score estimate --truth farm",
                              "farmgen generate two_plots.yaml -o farm --force"}) {
    const Finished finished = run(command, folder_.path().string());
    EXPECT_EQ(finished.exit_code, 2) << command;
    EXPECT_THAT(finished.errors, HasSubstr("manifest.json: is of format 2, which is newer"))
        << command;
  }
}

}  // namespace
}  // namespace plotscan::testing
