// SPDX-License-Identifier: Apache-2.0
// Farms and flights of the library against those of the programs: the same bytes.
#include <map>

#include <gmock/gmock.h>

#include "chain/programs.h"
#include "example_scan.h"

namespace plotscan {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;
namespace fs = std::filesystem;

void expect_same_files(const fs::path& a, const fs::path& b) {
  const auto finished =
      testing::run("diff -r '" + a.string() + "' '" + b.string() + "'", a.parent_path());
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
}

std::string message(const std::function<void()>& work) {
  try {
    work();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(LibraryFarm, IsTheProgramsFarm) {
  const TemporaryFolder folder;
  const FarmSummary made =
      generate_farm("paper_flat", folder.path() / "ours", {.set = testing::kSmall, .seed = 101});
  std::string command = "farmgen generate paper_flat -o theirs --seed 101";
  for (const std::string& set : testing::kSmall) command += " --set " + set;
  ASSERT_EQ(testing::run(command, folder.path()).exit_code, 0);
  expect_same_files(folder.path() / "ours", folder.path() / "theirs");
  EXPECT_EQ(made.plots, 9u);
  EXPECT_EQ(made.plants, 360u);
  EXPECT_EQ(made.seed, 101u);
  const std::vector<TruePlot> truth = read_truth(folder.path() / "ours");
  ASSERT_EQ(truth.size(), 9u);
  double tallest = 0;
  for (const TruePlot& plot : truth) tallest = std::max(tallest, plot.heights_m.at("height_max_m"));
  EXPECT_NEAR(tallest, made.plant_height_max_m, 1e-6);
}

TEST(LibraryFlight, IsTheProgramsFlight) {
  const TemporaryFolder folder;
  generate_farm("paper_flat", folder.path() / "farm", {.set = testing::kSmall, .seed = 101});
  const FlightSummary flown = fly(
      folder.path() / "farm", folder.path() / "ours",
      {.settings = {{"sensor", "puck_hires"}, {"speed_m_s", 5.0}, {"sub_rays", 2.0}}, .seed = 5});
  const auto program = testing::run(
      "lidarsim fly farm -o theirs --sensor puck_hires --speed 5 --sub-rays 2 --seed 5 -j 1",
      folder.path());
  ASSERT_EQ(program.exit_code, 0) << program.errors;
  expect_same_files(folder.path() / "ours", folder.path() / "theirs");
  EXPECT_GT(flown.points, 10'000u);
  EXPECT_GE(flown.shots, flown.points / 2);
}

TEST(LibraryFlight, TellsItsSettings) {
  std::map<std::string, Setting> settings;
  for (const Setting& setting : flight_settings()) settings[setting.key] = setting;
  EXPECT_EQ(std::get<double>(*settings.at("altitude_m").usual), 8);
  EXPECT_EQ(std::get<std::string>(*settings.at("sensor").usual), "vlp16");
  EXPECT_THAT(settings.at("pattern").choices, ::testing::Contains("crosshatch"));
  EXPECT_FALSE(settings.at("heading_deg").usual.has_value());
}

TEST(LibraryFlight, RefusesWhatCannotBe) {
  const TemporaryFolder folder;
  generate_farm("paper_flat", folder.path() / "farm", {.set = testing::kSmall, .seed = 101});
  const auto flown_with = [&](const std::string& key, const SettingValue& value) {
    return message([&] {
      fly(folder.path() / "farm", folder.path() / "scan", {.settings = {{key, value}}});
    });
  };
  EXPECT_THAT(flown_with("altitude", 8.0), HasSubstr("the flight has no \"altitude\"; it has"));
  EXPECT_THAT(flown_with("altitude_m", "8"), HasSubstr("altitude_m is a number"));
  EXPECT_THAT(flown_with("sub_rays", 1.5), HasSubstr("sub_rays is a whole number"));
  EXPECT_THAT(flown_with("altitude_m", -8.0), HasSubstr("--altitude"));
  EXPECT_FALSE(fs::exists(folder.path() / "scan"));
  EXPECT_THAT(message([&] { generate_farm("nowhere.yaml", folder.path() / "f"); }),
              HasSubstr("nowhere.yaml"));
}

}  // namespace
}  // namespace plotscan
