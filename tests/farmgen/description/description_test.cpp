// SPDX-License-Identifier: Apache-2.0

#include <numbers>
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "description/load_description.h"
#include "temporary_folder.h"

namespace plotscan::description {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::EndsWith;
using ::testing::HasSubstr;

// Line numbers of this text are in the tests below.
constexpr const char* kBase =
    "name: base\n"                                                                 // 1
    "seed: 7\n"                                                                    // 2
    "terrain:\n"                                                                   // 3
    "  side_m: 30\n"                                                               // 4
    "  vertices: 12\n"                                                             // 5
    "  relief_m: 0.25\n"                                                           // 6
    "plots:\n"                                                                     // 7
    "  width_m: 1.5\n"                                                             // 8
    "  length_m: 4\n"                                                              // 9
    "  gap_width_m: 0.5\n"                                                         // 10
    "  heading_deg: 90\n"                                                          // 11
    "  position_m: [1, -2]\n"                                                      // 12
    "  rows:\n"                                                                    // 13
    "    - {plots: 10, offset_m: 0.5}\n"                                           // 14
    "    - plots: 3\n"                                                             // 15
    "plants:\n"                                                                    // 16
    "  count: 90\n"                                                                // 17
    "  pattern: drilled\n"                                                         // 18
    "  drill_rows: 3\n"                                                            // 19
    "  scale: [0.8, 1.2]\n"                                                        // 20
    "  models:\n"                                                                  // 21
    "    - a/one.obj\n"                                                            // 22
    "    - {mesh: b/two.dae, name: second, up: y, unit_m: 0.01, foot: lowest}\n";  // 23

planting::FarmDescription load(const std::string& text,
                               const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  for (const char* file : {"a/one.obj", "b/two.dae", "m.obj", "t.csv", "p.geojson", "ground.stl"}) {
    folder.write(file, "");
  }
  return load_description(folder.write("farm.yaml", text), overrides);
}

std::string replaced(const std::string& old_text, const std::string& new_text) {
  std::string text = kBase;
  const auto place = text.find(old_text);
  if (place == std::string::npos) throw std::logic_error("the base has no " + old_text);
  return text.replace(place, old_text.size(), new_text);
}

TEST(Description, ReadsEveryKey) {
  const planting::FarmDescription farm = load(kBase);
  EXPECT_EQ(farm.name, "base");
  EXPECT_EQ(farm.seed, 7u);
  EXPECT_EQ(farm.terrain.side_m, 30);
  EXPECT_EQ(farm.terrain.vertices, 12u);
  EXPECT_EQ(farm.terrain.relief_m, 0.25);
  EXPECT_EQ(farm.trials[0].plots.width_m, 1.5);
  EXPECT_EQ(farm.trials[0].plots.length_m, 4);
  EXPECT_EQ(farm.trials[0].plots.gap_width_m, 0.5);
  EXPECT_EQ(farm.trials[0].plots.gap_length_m, 0);
  EXPECT_DOUBLE_EQ(farm.trials[0].plots.heading_rad, std::numbers::pi / 2);
  EXPECT_EQ(farm.trials[0].plots.position_m, Eigen::Vector2d(1, -2));
  ASSERT_EQ(farm.trials[0].plots.rows.size(), 2u);
  EXPECT_EQ(farm.trials[0].plots.rows[0].plots, 10u);
  EXPECT_EQ(farm.trials[0].plots.rows[0].offset_m, 0.5);
  EXPECT_EQ(farm.trials[0].plots.rows[1].plots, 3u);
  EXPECT_EQ(farm.trials[0].plants->cultivars[0].count, 90u);
  EXPECT_EQ(farm.trials[0].plants->cultivars[0].pattern, planting::PlantPattern::drilled);
  EXPECT_EQ(farm.trials[0].plants->cultivars[0].drill_rows, 3u);
  EXPECT_EQ(farm.trials[0].plants->cultivars[0].min_scale, 0.8);
  EXPECT_EQ(farm.trials[0].plants->cultivars[0].max_scale, 1.2);
  ASSERT_EQ(farm.models.size(), 2u);
  EXPECT_EQ(farm.models[0].name, "one");
  EXPECT_EQ(farm.models[0].mesh, farm.source.parent_path() / "a/one.obj");
  EXPECT_FALSE(farm.models[0].options.up);
  EXPECT_EQ(farm.models[1].name, "second");
  EXPECT_EQ(farm.models[1].mesh, farm.source.parent_path() / "b/two.dae");
  EXPECT_EQ(farm.models[1].options.up, mesh::UpAxis::y);
  EXPECT_EQ(farm.models[1].options.unit_m, 0.01);
  EXPECT_EQ(farm.models[1].options.foot, mesh::MeshFoot::lowest);
}

TEST(Description, OverridesReplaceAndAdd) {
  const planting::FarmDescription farm =
      load(kBase, {"terrain.relief_m=1", "plots.rows.1.plots=5", "plots.gap_length_m=2",
                   "plants.scale=[0.5, 0.6]", "name=other", "name=last"});
  EXPECT_EQ(farm.terrain.relief_m, 1);
  EXPECT_EQ(farm.trials[0].plots.rows[0].plots, 10u);
  EXPECT_EQ(farm.trials[0].plots.rows[1].plots, 5u);
  EXPECT_EQ(farm.trials[0].plots.gap_length_m, 2);
  EXPECT_EQ(farm.trials[0].plants->cultivars[0].min_scale, 0.5);
  EXPECT_EQ(farm.name, "last");
  EXPECT_EQ(farm.models.size(), 2u);
}

TEST(Description, NameIsTheFilesWhereAbsent) {
  EXPECT_EQ(load(replaced("name: base\n", "")).name, "farm");
}

struct Mistake {
  const char* name;
  const char* old_text;
  const char* new_text;
  const char* message;  // after the file's name
};

// GoogleTest prints it beside the test's name.
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class MistakenDescription : public ::testing::TestWithParam<Mistake> {};

TEST_P(MistakenDescription, NamesLineKeyAndRange) {
  const std::string text = replaced(GetParam().old_text, GetParam().new_text);
  EXPECT_THAT(message_of<InputError>([&] { load(text); }),
              EndsWith(std::string("farm.yaml:") + GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Description, MistakenDescription,
    ::testing::Values(
        Mistake{"UnknownKey", "  vertices: 12\n", "  vertexes: 12\n",
                "5: terrain.vertexes is not a known key; known here are mesh, heightmap, xyz, "
                "side_m, vertices, relief_m, slope, rolling, furrows, clods, step_m, detail_m, "
                "reflectance"},
        Mistake{"UnknownSection", "plots:", "ground: 3\nplots:",
                "7: ground is not a known key; known here are name, seed, anchor, terrain, layout, "
                "trials, plots, plants, weeds"},
        Mistake{"MisspeltSection",
                "terrain:", "terain:", "3: terain is not a known key, and terrain is missing"},
        Mistake{"MissingSection", "terrain:", "ground:", "1: terrain is missing"},
        Mistake{"KeyTwice", "  vertices: 12\n", "  side_m: 31\n",
                "5: terrain.side_m is given twice"},
        Mistake{"WrongType", "side_m: 30", "side_m: wide",
                "4: terrain.side_m \"wide\" is not a number; allowed are [1, 100000]"},
        Mistake{"ListForNumber", "side_m: 30", "side_m: [30, 30]",
                "4: terrain.side_m is not a single value"},
        Mistake{"Nan", "side_m: 30", "side_m: nan", "4: terrain.side_m nan is not in [1, 100000]"},
        Mistake{"TooLarge", "side_m: 30", "side_m: 1e9",
                "4: terrain.side_m 1e9 is not in [1, 100000]"},
        Mistake{"NegativeRelief", "0.25", "-0.25", "6: terrain.relief_m -0.25 is not in [0, 1000]"},
        Mistake{"NotWhole", "vertices: 12", "vertices: 12.5",
                "5: terrain.vertices \"12.5\" is not a whole number in [0, 1000000]"},
        Mistake{"Missing", "  width_m: 1.5\n", "", "8: plots.width_m is missing"},
        Mistake{"ScalarForSection", "  side_m: 30\n  vertices: 12\n  relief_m: 0.25\n", "  flat\n",
                "4: terrain is not a map of keys to values"},
        Mistake{"NoPlotsInRow", "plots: 3", "plots: 0",
                "15: plots.rows.1.plots 0 is not in [1, 100000]"},
        Mistake{"RowsNoList", "    - {plots: 10, offset_m: 0.5}\n    - plots: 3\n", "    all\n",
                "14: plots.rows is not a list of 1 to 10000 entries"},
        Mistake{"RowNoMap", "    - plots: 3\n", "    - 3\n",
                "15: plots.rows.1 is not a map of keys to values"},
        Mistake{"TooManyPlots", "plots: 10,", "plots: 100000,",
                "14: plots.rows hold 100003 plots; at most 100000 are allowed"},
        Mistake{"TooManyPlants", "count: 90", "count: 1000000",
                "17: plants.count makes 13000000 plants in 13 plots; at most 10000000 are allowed"},
        Mistake{"PositionNoPair", "[1, -2]", "[1, -2, 3]",
                "12: plots.position_m is not a list of two numbers in [-100000, 100000]"},
        Mistake{"PositionNoNumbers", "[1, -2]", "[1, far]",
                "12: plots.position_m [1, far] is not a pair of numbers in [-100000, 100000]"},
        Mistake{"ScaleTurnedRound", "[0.8, 1.2]", "[1.2, 0.8]",
                "20: plants.scale is not [min, max]: min is the larger"},
        Mistake{"ScaleZero", "[0.8, 1.2]", "[0, 1.2]",
                "20: plants.scale [0, 1.2] is not a pair of numbers in [0.01, 100]"},
        Mistake{"UnknownPattern", "drilled", "sown",
                "18: plants.pattern \"sown\" is not one of random, drilled"},
        Mistake{"DrillRowsOfRandom", "pattern: drilled", "pattern: random",
                "19: plants.drill_rows belongs to pattern: drilled; the pattern is random"},
        Mistake{"UnknownAxis", "up: y", "up: x", "23: plants.models.1.up \"x\" is not one of z, y"},
        Mistake{"SameModelTwice", "name: second", "name: one",
                "22: plants.models has two models named \"one\"; give one of them another name"},
        Mistake{"ModelNamedAsPath", "name: second", "name: ../second",
                "23: plants.models.1.name \"../second\" is not a name: 1 to 64 letters, digits, "
                "'-', '_', '.', not beginning with '.'"},
        Mistake{"ModelNamedTerrain", "name: second", "name: terrain",
                "23: plants.models.1.name \"terrain\" is the terrain's own name"},
        Mistake{"NegativeSeed", "seed: 7", "seed: -7",
                "2: seed \"-7\" is not a whole number in [0, 18446744073709551615]"},
        Mistake{"EmptyName", "name: base", "name: ''", "1: name is empty"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

TEST(Description, FilesThatItNamesHaveToExist) {
  const auto message = [](const std::string& old_text, const std::string& new_text) {
    return message_of<InputError>([&] { load(replaced(old_text, new_text)); });
  };
  EXPECT_THAT(message("a/one.obj", "a/none.obj"),
              HasSubstr("farm.yaml:22: plants.models.0 \"a/none.obj\" is no file (looked for "));
  EXPECT_THAT(message("b/two.dae", "b"), HasSubstr("farm.yaml:23: plants.models.1.mesh \"b\""));
  EXPECT_THAT(message("side_m: 30\n  vertices: 12\n  relief_m: 0.25\n", "mesh: hill.obj\n"),
              HasSubstr("farm.yaml:4: terrain.mesh \"hill.obj\" is no file"));
}

TEST(Description, LayoutTakesThePlaceOfPlants) {
  const std::string with_both = std::string(kBase) + "layout: {plants: t.csv, models: [m.obj]}\n";
  EXPECT_THAT(message_of<InputError>([&] { load(with_both); }),
              HasSubstr("farm.yaml:24: layout takes the place of plants"));
  const planting::FarmDescription farm = load(
      "terrain: {mesh: ground.stl, unit_m: 0.001}\n"
      "layout: {plants: t.csv, models: [m.obj], plots: p.geojson, columns: {x_m: east}}\n");
  EXPECT_EQ(farm.terrain.mesh, farm.source.parent_path() / "ground.stl");
  EXPECT_EQ(farm.terrain.mesh_options.unit_m, 0.001);
  EXPECT_EQ(farm.layout->columns.at("x_m"), "east");
  EXPECT_EQ(farm.layout->plots, farm.source.parent_path() / "p.geojson");
  EXPECT_EQ(planting::input_files(farm).size(), 5u);
  EXPECT_THAT(message_of<InputError>([&] {
                load(
                    "terrain: {side_m: 9}\n"
                    "layout: {plants: t.csv, models: [m.obj], columns: {east: x_m}}\n");
              }),
              HasSubstr("farm.yaml:2: layout.columns.east is not a known key; known here are "
                        "model, x_m, y_m, id, z_m"));
}

TEST(Description, BrokenFilesAreRefused) {
  EXPECT_THAT(message_of<InputError>([] { load("terrain: {side_m: 3\nplots: 4\n"); }),
              HasSubstr("farm.yaml:2: not YAML: "));
  EXPECT_THAT(message_of<InputError>([] { load("- a\n- b\n"); }),
              HasSubstr("farm.yaml:1: is not a map"));
  EXPECT_THAT(message_of<InputError>([] { load(""); }), HasSubstr("farm.yaml:1: is not a map"));
  EXPECT_THAT(message_of<InputError>([] { load_description("/no/farm.yaml"); }),
              HasSubstr("/no/farm.yaml: no such file"));
}

TEST(Description, MistakesInOverridesNameTheOverride) {
  const auto message = [](const std::string& assignment) {
    return message_of<InputError>([&] { load(kBase, {assignment}); });
  };
  EXPECT_EQ(message("terrain.relief_m=-1"),
            "--set terrain.relief_m=-1: terrain.relief_m -1 is not in [0, 1000]");
  EXPECT_EQ(message("terrain.relief=1"),
            "--set terrain.relief=1: terrain.relief is not a known key; known here are mesh, "
            "heightmap, xyz, side_m, vertices, relief_m, slope, rolling, furrows, clods, step_m, "
            "detail_m, reflectance");
  EXPECT_EQ(message("plots.rows.2.plots=1"),
            "--set plots.rows.2.plots=1: \"2\" is not an index of a list of 2 entries (from 0)");
  EXPECT_EQ(message("name.first=1"),
            "--set name.first=1: \"first\" names a part of the plain value base");
  EXPECT_EQ(message("plots.rows=[{plots: 0}]"),
            "--set plots.rows=[{plots: 0}]: plots.rows.0.plots 0 is not in [1, 100000]");
  EXPECT_EQ(message("relief"), "--set relief: expected key=value, as in terrain.relief_m=0.5");
  EXPECT_EQ(message("a..b=1"), "--set a..b=1: the key has an empty part");
  EXPECT_THAT(message("plants.scale=[1"), HasSubstr("--set plants.scale=[1: "));
}

}  // namespace
}  // namespace plotscan::description
