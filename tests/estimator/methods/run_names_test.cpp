// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/plot_features.h"
#include "core/random.h"
#include "methods/run.h"
#include "run_on_farm.h"

namespace plotscan::methods {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;
using testing::kFarm;
using testing::small_run;
using testing::write_cloud;

// A breeder's map of two plots of the farm, and what the method makes of it.
RunOptions run_in_boxes(const TemporaryFolder& folder, const nlohmann::json& of_first,
                        const nlohmann::json& of_second) {
  RunOptions options = small_run(folder, kFarm);
  options.dhami2020.plots = 0;
  options.boxes = folder.path() / "map.geojson";
  write_plot_features(*options.boxes, {{.box = kFarm.box(1, 2), .properties = of_first},
                                       {.box = kFarm.box(0, 0), .properties = of_second}});
  return options;
}

nlohmann::json properties_of(const RunOptions& options, std::size_t feature) {
  const auto written = nlohmann::json::parse(read_text(options.output / "plots.geojson"));
  return written["features"][feature]["properties"];
}

TEST(Run, KeepsTheNamesOfGivenPlots) {
  const TemporaryFolder folder;
  const RunOptions options =
      run_in_boxes(folder, {{"plot_number", 42}, {"row_number", 2}, {"col_number", 3}},
                   {{"plot_number", 8000000000123}});
  const estimate::Estimate estimate = run(options);
  ASSERT_EQ(estimate.plots.size(), 2u);
  EXPECT_EQ(estimate.plots[0].id, 42u);
  EXPECT_EQ(estimate.plots[0].row, 2);
  EXPECT_EQ(estimate.plots[0].column, 3);
  EXPECT_EQ(estimate.plots[1].id, 8000000000123u);
  EXPECT_NEAR(estimate.plots[0].heights_m.at("raw-max"), kFarm.height_m(1, 2), 1e-4);
  EXPECT_NEAR(estimate.plots[1].heights_m.at("raw-max"), kFarm.height_m(0, 0), 1e-4);
  EXPECT_EQ(properties_of(options, 1)["plot_number"], 8000000000123);
  EXPECT_EQ(estimate::read_estimate(options.output).plots[1].id, 8000000000123u);
}

TEST(Run, AnEarlierEstimatesFolderIsAMap) {
  const TemporaryFolder folder;
  RunOptions options = run_in_boxes(folder, {{"plot_number", 42}}, {{"plot_number", 7}});
  run(options);
  options.boxes = options.output;
  options.output = folder.path() / "again";
  EXPECT_EQ(run(options).plots[0].id, 42u);
  EXPECT_EQ(read_manifest(options.output)["inputs"][1]["hash"],
            file_hash(*options.boxes / "plots.geojson"));
  options.output = *options.boxes / "within";
  EXPECT_THAT(message_of<InputError>([&] { run(options); }), HasSubstr("lies in the input"));
}

TEST(Run, TakesNoFarmsFolderForAMap) {
  const TemporaryFolder folder;
  RunOptions options = run_in_boxes(folder, {{"plot_number", 42}}, {{"plot_number", 7}});
  fs::create_directories(folder.path() / "farm" / "truth");
  fs::copy_file(*options.boxes, folder.path() / "farm" / "truth" / "plots.geojson");
  options.boxes = folder.path() / "farm";
  EXPECT_THAT(message_of<InputError>([&] { run(options); }), HasSubstr("its map is the truth"));
  EXPECT_FALSE(fs::exists(options.output));
}

// As if each trial had a map of its own: its crop is not the other's.
TEST(Run, MeasuresTheTrialsOfAMapOneByOne) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  options.method = "lattice";
  options.crop_box = kFarm.area();
  options.replace = true;
  const auto heights_of = [&](const std::vector<int>& trials, const std::vector<int>& columns) {
    std::vector<PlotFeature> plots;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      plots.push_back({.box = kFarm.box(0, columns[i])});
      if (!trials.empty()) plots.back().properties["trial_number"] = trials[i];
    }
    options.boxes = folder.path() / "map.geojson";
    write_plot_features(*options.boxes, plots);
    std::vector<double> heights_m;
    for (const estimate::PlotEstimate& plot : run(options).plots)
      heights_m.push_back(plot.heights_m.at("mean"));
    return heights_m;
  };
  const std::vector<double> of_trials = heights_of({2, 1, 2, 1}, {0, 1, 2, 3});
  EXPECT_EQ(properties_of(options, 0)["trial_number"], 2);
  const std::vector<double> first = heights_of({}, {0, 2}), pooled = heights_of({}, {0, 1, 2, 3});
  EXPECT_NE(of_trials, pooled);
  EXPECT_EQ(of_trials[0], first[0]);
}

TEST(Run, RefusesTheOutlineOfAFieldAsAPlot) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  options.boxes = folder.path() / "map.geojson";
  write_plot_features(*options.boxes, {{.box = {.width_m = 120, .length_m = 150},
                                        .properties = {{"name", "north"}}}});
  EXPECT_THAT(message_of<InputError>([&] { run(options); }),
              HasSubstr("map.geojson: plot north is 120 x 150 m; a plot has up to 10000 m2"));
}

TEST(Run, GivesTheMapBackWithHeightsAdded) {
  const TemporaryFolder folder;
  const nlohmann::json first = {{"plot_id", "A-12"},   {"cultivar", "Rock, \"early\""},
                                {"sown", nullptr},     {"checks", {1, 2}},
                                {"row_number", "R02"}, {"density", 30.5}};
  const RunOptions options = run_in_boxes(folder, first, {{"plot_id", "0101"}});
  run(options);
  const nlohmann::json properties = properties_of(options, 0);
  for (const auto& [name, value] : first.items()) EXPECT_EQ(properties[name], value) << name;
  EXPECT_NEAR(properties["height_raw-max_m"].get<double>(), kFarm.height_m(1, 2), 1e-4);
  EXPECT_FALSE(properties.contains("plot_number"));
  EXPECT_EQ(properties_of(options, 1)["plot_id"], "0101");
  const estimate::Estimate read = estimate::read_estimate(options.output);
  EXPECT_EQ(read.plots[0].id, PlotId("A-12"));
  EXPECT_EQ(read.plots[1].id, PlotId("0101"));
  const std::string table = read_text(options.output / "heights.csv");
  EXPECT_THAT(table, ::testing::StartsWith("plot_id,row_number,col_number,center_x_m"));
  EXPECT_THAT(table, HasSubstr(",checks,cultivar,density,sown\n"));
  EXPECT_THAT(table, HasSubstr("\nA-12,R02,,"));
  EXPECT_THAT(table, HasSubstr(R"(,"[1,2]","Rock, ""early""",30.5,)"));
  EXPECT_THAT(table, HasSubstr("\n0101,,,"));
}

// The plots of one date as the map of the next, and of a third: what was measured before is not
// copied on.
TEST(Run, TakesItsOwnResultsForTheNextDate) {
  const TemporaryFolder folder;
  RunOptions options =
      run_in_boxes(folder, {{"plot_id", "A-12"}, {"cultivar", "Rock"}, {"height_hand3_m", 9.5}},
                   {{"plot_id", "A-13"}, {"cultivar", "Ur"}});
  run(options);
  const nlohmann::json first = properties_of(options, 0);
  ASSERT_TRUE(first.contains("given_height_hand3_m"));
  for (const char* date : {"second", "third"}) {
    options.boxes = options.output / "plots.geojson";
    options.output = folder.path() / date;
    run(options);
    nlohmann::json expected = first;
    expected.erase("given_height_hand3_m");
    std::vector<std::string> names, expected_names;
    const nlohmann::json properties = properties_of(options, 0);
    for (const auto& [name, value] : properties.items()) names.push_back(name);
    for (const auto& [name, value] : expected.items()) expected_names.push_back(name);
    EXPECT_EQ(names, expected_names) << date;
    EXPECT_EQ(properties["cultivar"], "Rock");
  }
}

// A map with heights, such as a farm's truth: they must not pass for measured ones.
TEST(Run, CallsGivenHeightsGiven) {
  const TemporaryFolder folder;
  const RunOptions options =
      run_in_boxes(folder, {{"height_hand3_m", 9.5}, {"height_raw-max_m", 9.5}, {"points", 7}}, {});
  run(options);
  const nlohmann::json properties = properties_of(options, 0);
  EXPECT_EQ(properties["given_height_hand3_m"], 9.5);
  EXPECT_EQ(properties["given_height_raw-max_m"], 9.5);
  EXPECT_EQ(properties["given_points"], 7);
  EXPECT_EQ(properties["plot_number"], 1);
  const estimate::Estimate read = estimate::read_estimate(options.output);
  EXPECT_FALSE(read.plots[0].heights_m.contains("hand3"));
  EXPECT_NEAR(read.plots[0].heights_m.at("raw-max"), kFarm.height_m(1, 2), 1e-4);
}

TEST(Run, TakesTheIdFromTheNamedProperty) {
  const TemporaryFolder folder;
  RunOptions options = run_in_boxes(folder, {{"plot_number", 1}, {"barcode", "x7"}},
                                    {{"plot_number", 1}, {"barcode", "x8"}});
  const auto message = [&] { return message_of<InputError>([&] { run(options); }); };
  EXPECT_THAT(message(), HasSubstr("feature 1 and feature 2 have the same plot_number \"1\""));
  EXPECT_THAT(message(), HasSubstr("--id"));
  options.id = "Barcode";
  EXPECT_THAT(message(), HasSubstr("barcode"));
  EXPECT_FALSE(fs::exists(options.output));
  options.id = "barcode";
  EXPECT_EQ(run(options).plots[1].id, PlotId("x8"));
  EXPECT_EQ(properties_of(options, 1)["plot_number"], 1);
  EXPECT_EQ(estimate::read_estimate(options.output).plots[1].id, PlotId("x8"));
}

TEST(Run, RefusesAMapInWhichSomePlotsHaveNoId) {
  const TemporaryFolder folder;
  const RunOptions options = run_in_boxes(folder, {{"name", "north"}}, {{"name", " "}});
  EXPECT_THAT(message_of<InputError>([&] { run(options); }),
              HasSubstr("feature 2 has no id in its property \"name\""));
}

TEST(Run, NumbersAndNamesThePlotsThatItFinds) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  options.numbering.first_number = 101;
  run(options);
  EXPECT_EQ(properties_of(options, 7)["plot_number"], 108);
  EXPECT_THAT(read_text(options.output / "heights.csv"), HasSubstr("\n101,1,1,"));
  std::string table = "row,column,plot,sown\n";
  for (int row = 1; row <= 2; ++row) {
    for (int column = 1; column <= 4; ++column) {
      table += std::to_string(row) + "," + std::to_string(column) + ",p" + std::to_string(row) +
               std::to_string(column) + ",May\n";
    }
  }
  options.numbering = {.names = folder.write("book.csv", table)};
  options.id = "plot";
  options.replace = true;
  run(options);
  EXPECT_EQ(properties_of(options, 7)["plot"], "p24");
  EXPECT_EQ(properties_of(options, 7)["sown"], "May");
  EXPECT_EQ(properties_of(options, 7)["row_number"], 2);
  const auto message = [&] { return message_of<InputError>([&] { run(options); }); };
  options.numbering.first_number = 1;
  EXPECT_THAT(message(), HasSubstr("not both"));
  options.numbering = {};
  EXPECT_THAT(message(), HasSubstr("give one of these"));
}

TEST(Run, WritesATableForDatabases) {
  const TemporaryFolder folder;
  RunOptions options = run_in_boxes(folder, {{"plot_id", "A-12"}, {"cultivar", "Rock, early"}},
                                    {{"plot_id", "0101"}, {"row_number", 7}});
  options.csv = folder.path() / "traits.csv";
  const estimate::Estimate estimate = run(options);
  const CsvTable table = read_csv_table(*options.csv);
  EXPECT_THAT(table.columns,
              ::testing::ElementsAre("observationunit_name", "row_number", "col_number", "cultivar",
                                     "plot_id", "height_raw-max_m", "height_raw-p99_m",
                                     "height_voxel-max_m", "flags"));
  ASSERT_EQ(table.lines.size(), 2u);
  const double height_m = estimate.plots[0].heights_m.at("raw-max");
  EXPECT_EQ(table.lines[0].fields[0], "A-12");
  EXPECT_EQ(table.lines[0].fields[1], "") << "of no grid";
  EXPECT_EQ(table.lines[0].fields[3], "Rock, early");
  EXPECT_EQ(table.lines[0].fields[5], format_number(height_m));
  EXPECT_EQ(table.lines[1].fields[0], "0101");
  EXPECT_EQ(table.lines[1].fields[1], "7");
}

TEST(Run, PutsATableWhereItHarmsNothing) {
  const TemporaryFolder folder;
  RunOptions options = run_in_boxes(folder, {{"plot_id", "A"}}, {{"plot_id", "B"}});
  const auto message = [&] { return message_of<InputError>([&] { run(options); }); };
  options.csv = folder.write("traits.csv", "kept");
  EXPECT_THAT(message(), HasSubstr("--force"));
  EXPECT_EQ(read_text(*options.csv), "kept");
  options.replace = true;
  options.csv = options.boxes;
  EXPECT_THAT(message(), HasSubstr("is an input"));
  options.csv = options.output / "traits.csv";
  EXPECT_THAT(message(), HasSubstr("lies in the estimate folder"));
  EXPECT_FALSE(fs::exists(options.output));
}

// A tile of a folder is an input though nobody named it.
TEST(Run, PutsATableOverNoTile) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  options.csv = write_cloud(folder.path() / "tiles" / "one.pcd", kFarm.points());
  options.cloud = CloudFiles(folder.path() / "tiles");
  options.replace = true;
  EXPECT_THAT(message_of<InputError>([&] { run(options); }), HasSubstr("is an input"));
}

}  // namespace
}  // namespace plotscan::methods
