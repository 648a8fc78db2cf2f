// SPDX-License-Identifier: Apache-2.0
#include "farmbench/suite.h"

#include <algorithm>
#include <ostream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "description/load_description.h"
#include "farmbench/methods.h"
#include "farmbench/suite_choice.h"
#include "planting/generate.h"
#include "temporary_folder.h"

namespace plotscan::farmbench {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::filesystem::path kSuites =
    std::filesystem::path(PLOTSCAN_SOURCE_DIR) / "benchmarks/suites";
const std::string kFlat = std::string(PLOTSCAN_SOURCE_DIR) + "/worlds/paper_flat.yaml";

// A sound suite, one key a line.
const std::string kSound =
    "name: mine\n"
    "cases:\n"
    "  - {name: a, farm: " +
    kFlat +
    "}\n"
    "seeds: [4]\n"
    "methods: [oracle-ground]\n";

// kSound with one line in place of another.
std::string with(const std::string& line, const std::string& other) {
  std::string text = kSound;
  return text.replace(text.find(line), line.size(), other);
}

TEST(LoadSuite, AMethodHasSettingsOfItsOwn) {
  const TemporaryFolder folder;
  const Suite suite = load_suite(
      folder.write("s.yaml", with("[oracle-ground]",
                                  "[lattice, lattice: {noise_m: 0.02, calibrated: false}, "
                                  "dhami2020 true-boxes: {voxel_m: 0.1}]")));
  EXPECT_THAT(suite.methods, ElementsAre("lattice", "lattice calibrated=false noise_m=0.02",
                                         "dhami2020 true-boxes voxel_m=0.1"));
  EXPECT_EQ(method_named(suite.methods[1]).heights.front().row,
            "lattice/max calibrated=false noise_m=0.02");
  EXPECT_EQ(method_named(suite.methods[2]).heights.front().row,
            "dhami2020/voxel-max true-boxes voxel_m=0.1");
}

TEST(LoadSuite, ThePapersProtocol) {
  const Suite suite = load_suite(kSuites / "paper.yaml");
  EXPECT_EQ(suite.name, "paper");
  EXPECT_THAT(suite.seeds, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
  ASSERT_EQ(suite.cases.size(), 3U);
  EXPECT_THAT(suite.methods, ElementsAre("lattice", "lattice calibrated=false", "dhami2020",
                                         "dhami2020 true-boxes", "oracle-ground", "one-number"));
  const double relief_m[] = {0, 0.5, 1};
  const double published_cm[] = {4.8, 6.1, 16.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const planting::FarmDescription farm = description::load_description(suite.cases[i].farm);
    EXPECT_EQ(farm.terrain.side_m, 80);
    EXPECT_EQ(farm.terrain.vertices, 150U);
    EXPECT_EQ(farm.terrain.relief_m, relief_m[i]);
    ASSERT_EQ(farm.trials[0].plants->cultivars.size(), 1U);
    EXPECT_EQ(farm.trials[0].plants->cultivars[0].count, 90U);
    ASSERT_EQ(farm.trials[0].plots.rows.size(), 3U);
    for (const planting::PlotRowDescription& row : farm.trials[0].plots.rows)
      EXPECT_EQ(row.plots, 10U);
    EXPECT_EQ(suite.cases[i].published_rmse_cm, published_cm[i]);
    EXPECT_EQ(suite.cases[i].flight.spin_jitter, "none") << "Gazebo's rays turn steadily";
  }
}

std::vector<std::string> shipped_suites() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kSuites))
    names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

class ShippedSuite : public ::testing::TestWithParam<std::string> {};

// Its descriptions hold, and its farms can be made: every plot on the terrain, every mesh there.
TEST_P(ShippedSuite, IsSound) {
  const Suite suite = load_suite(kSuites / (GetParam() + ".yaml"));
  EXPECT_EQ(suite.name, GetParam());
  for (const std::uint64_t seed : suite.seeds) EXPECT_LT(seed, 1000U) << "others tune";
  for (const SuiteCase& suite_case : suite.cases) {
    if (suite_case.overrides.empty()) continue;  // a shipped world, which has tests of its own
    const farm::Farm farm = planting::generate(
        description::load_description(suite_case.farm, suite_case.overrides), suite.seeds.front());
    EXPECT_FALSE(farm.plots.empty()) << suite_case.name;
    EXPECT_TRUE(suite_case.without_plots || !farm.plants.empty()) << suite_case.name;
    if (suite.sweep) break;  // its cases are flights over one kind of farm
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedSuite, ::testing::ValuesIn(shipped_suites()),
                         [](const auto& suite) {
                           std::string name = suite.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// Every case is as hard as its name says.
TEST(LoadSuite, HardFieldsAreHard) {
  const Suite suite = load_suite(kSuites / "hard.yaml");
  const auto made = [&](const std::string& name, std::uint64_t seed) {
    const auto found = std::ranges::find(suite.cases, name, &SuiteCase::name);
    if (found == suite.cases.end()) throw std::runtime_error("no case " + name);
    return planting::generate(description::load_description(found->farm, found->overrides), seed);
  };
  EXPECT_NE(made("heading", 1).plots[0].box.heading_rad,
            made("heading", 2).plots[0].box.heading_rad);
  std::size_t standing = 0;
  for (const std::uint64_t seed : suite.seeds) standing += made("missing", seed).plots.size();
  EXPECT_LT(standing, 30 * suite.seeds.size());
  EXPECT_EQ(made("plots-500", 1).plots.size(), 500U);
  EXPECT_EQ(made("unequal-rows", 1).plots.size(), 26U);
  const farm::Farm weeds = made("weeds", 1);
  EXPECT_GT(std::ranges::count(weeds.plants, farm::PlantKind::weed, &farm::Plant::kind), 100);
  for (const farm::Plot& plot : weeds.plots) EXPECT_EQ(plot.weed_count, 0U);
  for (const farm::Plot& plot : made("maize", 1).plots) EXPECT_NEAR(plot.heights.mean, 2.5, 0.15);
  for (const farm::Plot& plot : made("low", 1).plots) EXPECT_NEAR(plot.heights.mean, 0.2, 0.02);
}

TEST(LoadSuite, OverridesSeedsAndFlight) {
  const TemporaryFolder folder;
  const Suite suite = load_suite(folder.write(
      "s.yaml", with("seeds: [4]\n",
                     "seeds: {first: 7, count: 3}\nflight: {altitude_m: 12, range_noise_m: 0}\n")
                    .replace(kSound.find("}\n"), 1, ", set: {plots.rows: '[{plots: 2}]'}}")));
  EXPECT_THAT(suite.seeds, ElementsAre(7, 8, 9));
  EXPECT_EQ(suite.cases[0].flight.altitude_m, 12);
  EXPECT_EQ(suite.cases[0].flight.range_noise_m, 0);
  EXPECT_THAT(suite.cases[0].overrides, ElementsAre("plots.rows=[{plots: 2}]"));
}

TEST(ChosenSuite, TakesTheSuitesFirstSeeds) {
  const TemporaryFolder folder;
  const auto seeds = [&](const std::string& of_suite, int count) {
    return chosen_suite({.file = folder.write("s.yaml", with("[4]", of_suite)), .seeds = count})
        .seeds;
  };
  EXPECT_THAT(seeds("[3, 8, 5]", 2), ElementsAre(3, 8));
  EXPECT_THAT(seeds("[3, 8, 5]", 5), ElementsAre(3, 8, 5, 9, 10));
  EXPECT_THAT(seeds("{first: 7, count: 2}", 3), ElementsAre(7, 8, 9));
}

TEST(LoadSuite, CasesFlyTheirOwnWay) {
  const TemporaryFolder folder;
  const Suite suite = load_suite(folder.write(
      "s.yaml",
      "name: mine\nflight: {range_noise_m: 0, altitude_m: 12}\nbaseline: still\ncases:\n"
      "  - {name: still, farm: " +
          kFlat +
          "}\n"
          "  - {name: rtk, farm: " +
          kFlat +
          ", flight: {pose_error: rtk, altitude_m: 9, "
          "boresight_rpy_deg: [0, 0.1, 0]}}\n"
          "seeds: [4]\nmethods: [oracle-ground]\n"));
  EXPECT_EQ(suite.baseline, "still");
  EXPECT_EQ(suite.cases[0].flight.altitude_m, 12);
  EXPECT_EQ(suite.cases[0].flight.pose_error, "none");
  EXPECT_EQ(suite.cases[1].flight.altitude_m, 9);
  EXPECT_EQ(suite.cases[1].flight.range_noise_m, 0);
  EXPECT_EQ(suite.cases[1].flight.pose_error, "rtk");
  EXPECT_EQ(suite.cases[1].flight.pose_errors.boresight_rpy_deg.y(), 0.1);
}

struct BadSuite {
  std::string text;
  std::string message;  // after the file's name
};

// GoogleTest prints it beside the test's name.
void PrintTo(const BadSuite& suite, std::ostream* out) { *out << suite.message; }

class LoadSuiteErrors : public ::testing::TestWithParam<BadSuite> {};

TEST_P(LoadSuiteErrors, NameLineAndKey) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("s.yaml", GetParam().text);
  EXPECT_THAT(message_of<InputError>([&] { load_suite(file); }),
              HasSubstr(file.string() + GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Suites, LoadSuiteErrors,
    ::testing::Values(
        BadSuite{kSound + "colour: red\n", ":6: colour is not a known key"},
        BadSuite{with("[4]", "[4, four]"), ":4: seeds.1 \"four\" is not a whole number"},
        BadSuite{with("[4]", "[4, 4]"), ":4: seeds name 4 twice"},
        BadSuite{with("[4]", "{first: 1, count: 0}"), ":4: seeds.count 0 is not in [1, 10000]"},
        BadSuite{with("[4]", "4"), ":4: seeds is not a map"},
        BadSuite{with("[oracle-ground]", "[magic]"),
                 ":5: methods do not hold: there is no method \"magic\"; there are lattice, "},
        BadSuite{with("[oracle-ground]", "[lattice: {calibrated: maybe}]"),
                 ":5: methods do not hold: calibrated \"maybe\" must be one of true, false"},
        BadSuite{with("[oracle-ground]", "[lattice: {heading_deg: 400}]"),
                 ":5: methods do not hold: heading_deg 400 must be in [-360, 360]"},
        BadSuite{with("[oracle-ground]", "[lattice: {voxel_m: 1}]"),
                 ":5: methods do not hold: \"voxel_m=1\" is not one of heading_deg, plot_width_m"},
        BadSuite{with("[oracle-ground]", "[oracle-ground: {voxel_m: 1}]"),
                 ":5: methods do not hold: there is no method \"oracle-ground voxel_m=1\""},
        BadSuite{with("[oracle-ground]", "[{lattice: {rows: 2}, dhami2020: {}}]"),
                 ":5: methods.0 has to be a method's name, name: {key: value}, or"},
        BadSuite{with("[oracle-ground]", "[oracle-ground, oracle-ground]"), ":5: methods name"},
        BadSuite{with("name: mine", "name: a/b"), ":1: name \"a/b\" is not a name"},
        BadSuite{with("name: mine\n", ""), ":1: name is missing"},
        BadSuite{with("/paper_flat.yaml", "/none.yaml"), ":3: cases.0.farm does not hold"},
        BadSuite{with(".yaml}", ".yaml, set: {terrain.colour: 1}}"),
                 ":3: cases.0.farm does not hold: --set terrain.colour=1: terrain.colour is not a "
                 "known key"},
        BadSuite{with(".yaml}", ".yaml}\n  - {name: a, farm: " + kFlat + "}"),
                 ":4: cases.1.name \"a\" is the name of another case as well"},
        BadSuite{kSound + "flight: {altitude_m: 200}\n",
                 ":6: flight.altitude_m 200 is not in [0.5, 120]"},
        BadSuite{kSound + "baseline: other\n", ":6: baseline \"other\" is not one of"},
        BadSuite{with(".yaml}", ".yaml, flight: {pose_error: laser}}"),
                 ":3: cases.0.flight.pose_error \"laser\" is not one of"},
        BadSuite{with(".yaml}", ".yaml, survey_m: [1, 2, 0, 3]}"),
                 ":3: cases.0.survey_m does not hold: "},
        BadSuite{with(".yaml}", ".yaml, without_plots: yes}"),
                 ":3: cases.0.without_plots \"yes\" is not one of false, true"},
        BadSuite{with(".yaml}", ".yaml, without_plots: true, survey_m: [0, 0, 1, 1]}"),
                 ":3: cases.0.survey_m is of plots, and the case is without_plots"},
        BadSuite{kSound + "truths: [height_max]\n",
                 ":6: truths.0 \"height_max\" is not one of height_hand3_m, height_max_m"},
        BadSuite{kSound + "truths: [height_max_m, height_max_m]\n",
                 ":6: truths name height_max_m twice"},
        BadSuite{kSound + "published: {source: us, methods: [oracle]}\n",
                 ":6: published.methods name \"oracle\", which is no row"},
        BadSuite{kSound + "methods: [{name: my, command: 'true {cloud} {out}'}]\n"
                          "published: {source: us, methods: [mylongname/p99]}\n",
                 ":7: published.methods name \"mylongname/p99\", which is no row"},
        BadSuite{with(".yaml}", ".yaml, published_rmse_cm: 6}"),
                 ":3: cases.0.published_rmse_cm is shown nowhere: the suite must say whose it is"},
        BadSuite{kSound + "published: {source: us, methods: [oracle-ground]}\n",
                 ":6: published has no figures: no case has a published_rmse_cm"},
        BadSuite{kSound + "flight: fast\n", ":6: flight is not a map"}));

}  // namespace
}  // namespace plotscan::farmbench
