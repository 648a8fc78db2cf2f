// SPDX-License-Identifier: Apache-2.0
#include "estimate/run.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>

#include "synthetic_farm.h"
#include "temporary_folder.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/plot_features.h"
#include "core/random.h"

namespace plotscan::estimate {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;
using testing::SyntheticFarm;

// A binary PCD written by the test, with labels that an estimator must not need.
fs::path write_cloud(const fs::path& file, const std::vector<Eigen::Vector3d>& points) {
  const std::string count = std::to_string(points.size());
  std::string body = "VERSION 0.7\nFIELDS x y z plot\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n";
  body +=
      "WIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3f xyz = point.cast<float>();
    const std::uint32_t label = 7;
    char record[16];
    std::memcpy(record, xyz.data(), 12);
    std::memcpy(record + 12, &label, 4);
    body.append(record, sizeof record);
  }
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << body;
  return file;
}

RunOptions small_run(const TemporaryFolder& folder, const SyntheticFarm& farm) {
  RunOptions options{.cloud = write_cloud(folder.path() / "scan" / "cloud.pcd", farm.points()),
                     .output = folder.path() / "estimate"};
  options.method = "dhami2020";
  options.dhami2020.plots = 8;
  return options;
}

const SyntheticFarm kFarm{.rows = 2, .columns = 4};

TEST(Run, WritesAFolderFromWhichTheRunCanBeRepeated) {
  const TemporaryFolder folder;
  const RunOptions options = small_run(folder, kFarm);
  const Estimate estimate = run(options);
  EXPECT_EQ(estimate.plots.size(), 8u);
  const Estimate read = read_estimate(options.output);
  EXPECT_EQ(read.method, "dhami2020");
  ASSERT_EQ(read.plots.size(), 8u);
  EXPECT_EQ(read.plots[3].heights_m, estimate.plots[3].heights_m);
  const auto manifest = read_manifest(options.output);
  EXPECT_EQ(manifest["command"], "estimator run");
  EXPECT_EQ(manifest["options"]["plots"], 8);
  EXPECT_EQ(manifest["inputs"][0]["hash"], file_hash(options.cloud.files.front()));
  EXPECT_EQ(manifest["results"]["plots"], 8);
  EXPECT_EQ(manifest["results"]["heights"]["raw-max"]["plots"], 8);
  EXPECT_EQ(manifest["results"]["diagnostics"]["votes"]["clusters"], 8);
}

// Half a kilometre of town with a point on 250 square metres: over 200 s and 2.4 GB once.
TEST(Run, SaysOfASparseCloudThatItCannotShowPlots) {
  const TemporaryFolder folder;
  std::vector<Eigen::Vector3d> points;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    RandomStream random(2, random_purpose("test/town"), i);
    points.emplace_back(random.uniform(0, 500), random.uniform(0, 500), random.uniform(0, 0.05));
  }
  const RunOptions options{.cloud = write_cloud(folder.path() / "town" / "cloud.pcd", points),
                           .output = folder.path() / "estimate"};
  const Estimate estimate = run(options);
  EXPECT_TRUE(estimate.plots.empty());
  EXPECT_THAT(estimate.diagnostics["nothing"].get<std::string>(), HasSubstr("85 a square metre"));
  EXPECT_GT(estimate.diagnostics["ground"]["cell_m"], 5);
}

TEST(Run, SaysOfACloudWithoutGroundThatItHasNone) {
  const TemporaryFolder folder;
  std::vector<Eigen::Vector3d> points;
  for (std::uint64_t i = 0; i < 300000; ++i) {
    RandomStream random(3, random_purpose("test/scatter"), i);
    points.emplace_back(random.uniform(0, 20), random.uniform(0, 20), random.uniform(0, 3));
  }
  const RunOptions options{.cloud = write_cloud(folder.path() / "scatter" / "cloud.pcd", points),
                           .output = folder.path() / "estimate"};
  EXPECT_THAT(run(options).diagnostics["nothing"].get<std::string>(), HasSubstr("no ground"));
}

TEST(Run, TakesAScanFolderAndGivesTheSameBytes) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  run(options);
  const std::string first = read_text(options.output / "manifest.json");
  options.cloud = CloudFiles(folder.path() / "scan");
  options.threads = 2;
  options.replace = true;
  run(options);
  EXPECT_EQ(read_text(options.output / "manifest.json"), first);
}

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
  const Estimate estimate = run(options);
  ASSERT_EQ(estimate.plots.size(), 2u);
  EXPECT_EQ(estimate.plots[0].id, 42u);
  EXPECT_EQ(estimate.plots[0].row, 2);
  EXPECT_EQ(estimate.plots[0].column, 3);
  EXPECT_EQ(estimate.plots[1].id, 8000000000123u);
  EXPECT_NEAR(estimate.plots[0].heights_m.at("raw-max"), kFarm.height_m(1, 2), 1e-4);
  EXPECT_NEAR(estimate.plots[1].heights_m.at("raw-max"), kFarm.height_m(0, 0), 1e-4);
  EXPECT_EQ(properties_of(options, 1)["plot_number"], 8000000000123);
  EXPECT_EQ(read_estimate(options.output).plots[1].id, 8000000000123u);
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
  const Estimate read = read_estimate(options.output);
  EXPECT_EQ(read.plots[0].id, PlotId("A-12"));
  EXPECT_EQ(read.plots[1].id, PlotId("0101"));
  const std::string table = read_text(options.output / "heights.csv");
  EXPECT_THAT(table, ::testing::StartsWith("plot_id,row_number,col_number,center_x_m"));
  EXPECT_THAT(table, HasSubstr(",checks,cultivar,density,sown\n"));
  EXPECT_THAT(table, HasSubstr("\nA-12,R02,0,"));
  EXPECT_THAT(table, HasSubstr(R"(,"[1,2]","Rock, ""early""",30.5,)"));
  EXPECT_THAT(table, HasSubstr("\n0101,0,0,"));
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
  const Estimate read = read_estimate(options.output);
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
  EXPECT_EQ(read_estimate(options.output).plots[1].id, PlotId("x8"));
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
  EXPECT_THAT(message(), HasSubstr("give either"));
}

TEST(Run, WritesATableForDatabases) {
  const TemporaryFolder folder;
  RunOptions options = run_in_boxes(folder, {{"plot_id", "A-12"}, {"cultivar", "Rock, early"}},
                                    {{"plot_id", "0101"}, {"row_number", 7}});
  options.csv = folder.path() / "traits.csv";
  const Estimate estimate = run(options);
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

TEST(Run, KnowsWhenNothingWasMeasured) {
  Estimate estimate{
      .method = "lattice",
      .diagnostics = {
          {"points_in_area", 300}, {"area_m", {0, 0, 10, 20}}, {"nothing", "a reason"}}};
  const auto message = [&] {
    return message_of<NothingToMeasure>([&] { require_measured(estimate); });
  };
  EXPECT_THAT(message(), HasSubstr("no plots: a reason (1.5 points/m2)"));
  estimate.plots = {{.id = 1, .box = {}}, {.id = 2, .box = {}}};
  EXPECT_THAT(message(), HasSubstr("no plot has enough points for a height (1.5 points/m2)"));
  estimate.plots[1].heights_m["max"] = 0.5;
  EXPECT_NO_THROW(require_measured(estimate));
}

// The corner of the first plot in a plots.geojson.
Eigen::Vector2d first_corner(const fs::path& folder) {
  const auto document = nlohmann::json::parse(read_text(folder / "plots.geojson"));
  const auto& corner = document["features"][0]["geometry"]["coordinates"][0][0];
  return {corner[0].get<double>(), corner[1].get<double>()};
}

// The same polygons with nothing but an id and a cultivar.
nlohmann::json as_breeders_map(nlohmann::json map) {
  int plot = 0;
  for (auto& feature : map["features"]) {
    feature.erase("id");
    feature["properties"] = {{"plot_id", "A-" + std::to_string(++plot)}, {"cultivar", "Rock"}};
  }
  return map;
}

void expect_breeders_map(const fs::path& folder) {
  const Estimate read = read_estimate(folder);
  EXPECT_EQ(read.plots.at(3).id, PlotId("A-4"));
  const auto document = nlohmann::json::parse(read_text(folder / "plots.geojson"));
  EXPECT_EQ(document["features"][3]["properties"]["plot_id"], "A-4");
  EXPECT_EQ(document["features"][3]["properties"]["cultivar"], "Rock");
}

// A field in metres, and the same far away in US survey feet (z in them too): heights and boxes are
// the same metres, and the polygons lie on the cloud.
TEST(Run, FeetBecomeMetresAndGoBack) {
  const TemporaryFolder folder;
  constexpr double kFoot = 1200.0 / 3937.0;
  const Eigen::Vector3d moved(300000, 200000, 400);
  std::string text = "x,y,z\n";
  for (const Eigen::Vector3d& point : kFarm.points()) {
    const Eigen::Vector3d feet = (point + moved) / kFoot;
    text += format_number(feet.x()) + "," + format_number(feet.y()) + "," +
            format_number(feet.z()) + "\n";
  }
  RunOptions metres = small_run(folder, kFarm);
  RunOptions feet = metres;
  feet.cloud = folder.write("feet.csv", text);
  feet.output = folder.path() / "feet";
  feet.cloud.units = {kFoot, kFoot};
  const Eigen::Vector2d low = moved.head<2>() + Eigen::Vector2d(-30, -30);
  const Eigen::Vector2d high = moved.head<2>() + Eigen::Vector2d(30, 30);
  metres.crop_box = Area{-30, -30, 30, 30};
  feet.crop_box = Area{low.x() / kFoot, low.y() / kFoot, high.x() / kFoot, high.y() / kFoot};
  const Estimate expected = run(metres);
  const Estimate found = run(feet);
  ASSERT_EQ(found.plots.size(), expected.plots.size());
  EXPECT_NEAR(found.plots[3].heights_m.at("raw-max"), expected.plots[3].heights_m.at("raw-max"),
              1e-3);
  EXPECT_NEAR(found.plots[3].box.length_m, expected.plots[3].box.length_m, 0.05);
  EXPECT_LT(
      (first_corner(feet.output) * kFoot - moved.head<2>() - first_corner(metres.output)).norm(),
      0.1);
  EXPECT_THAT(found.diagnostics["notes"].dump(), HasSubstr("US survey feet are read as metres"));
  const Estimate read = read_estimate(feet.output);
  ASSERT_TRUE(read.units);
  EXPECT_LT((read.plots[3].box.center - found.plots[3].box.center).norm(), 1e-6);

  // A breeder's map, drawn over the cloud in a GIS, is in its feet.
  auto map = nlohmann::json::parse(read_text(feet.output / "plots.geojson"));
  map.erase("coordinate_units_m");
  feet.boxes = folder.write("map.geojson", as_breeders_map(map).dump());
  feet.dhami2020.plots = 0;
  feet.replace = true;
  const Estimate given = run(feet);
  EXPECT_NEAR(given.plots[3].heights_m.at("raw-max"), expected.plots[3].heights_m.at("raw-max"),
              1e-3);
  expect_breeders_map(feet.output);
  EXPECT_LT(
      (first_corner(feet.output) * kFoot - moved.head<2>() - first_corner(metres.output)).norm(),
      0.1);
  EXPECT_FALSE(fs::exists(feet.output / "plots.wgs84.geojson"));
}

// The same field in two tiles.
TEST(Run, AFolderOfTilesIsOneCloud) {
  const TemporaryFolder folder;
  RunOptions whole = small_run(folder, kFarm);
  RunOptions tiles = whole;
  std::vector<Eigen::Vector3d> west, east;
  for (const Eigen::Vector3d& point : kFarm.points())
    (point.x() < 0 ? west : east).push_back(point);
  ASSERT_FALSE(west.empty() || east.empty());
  write_cloud(folder.path() / "tiles" / "west.pcd", west);
  write_cloud(folder.path() / "tiles" / "east.pcd", east);
  tiles.cloud = CloudFiles(folder.path() / "tiles");
  tiles.output = folder.path() / "joined";
  const Estimate expected = run(whole);
  const Estimate found = run(tiles);
  ASSERT_EQ(found.plots.size(), expected.plots.size());
  for (std::size_t i = 0; i < found.plots.size(); ++i) {
    EXPECT_LT((found.plots[i].box.center - expected.plots[i].box.center).norm(), 0.1);
    EXPECT_NEAR(found.plots[i].heights_m.at("raw-max"), expected.plots[i].heights_m.at("raw-max"),
                1e-6);
  }
  EXPECT_EQ(read_manifest(tiles.output)["inputs"].size(), 2u);
}

// On the meridian of zone 31 a step of latitude is the meridian's arc, times 0.9996.
TEST(Run, DegreesAreProjectedToUtm) {
  const TemporaryFolder folder;
  std::string text = "lon lat height\n";
  constexpr double kLat = 48;
  for (const Eigen::Vector3d& point : kFarm.points()) {
    text += format_number(3 + point.x() / (111320 * std::cos(kLat * std::numbers::pi / 180))) +
            " " + format_number(kLat + point.y() / 111200) + " " + format_number(point.z()) + "\n";
  }
  RunOptions options = small_run(folder, kFarm);
  options.cloud = folder.write("degrees.txt", text);
  const Estimate estimate = run(options);
  EXPECT_EQ(estimate.plots.size(), 8u);
  EXPECT_EQ(estimate.crs, "EPSG:32631");
  EXPECT_NEAR(first_corner(options.output).x(), 500000, 50);
  EXPECT_NEAR(first_corner(options.output).y(), 5316300, 500);
  EXPECT_THAT(estimate.diagnostics["notes"].dump(), HasSubstr("zone 31N"));

  // Its plots in degrees are a map as any breeder's; so are those in the zone's metres.
  for (const char* const name : {"plots.wgs84.geojson", "plots.geojson"}) {
    const auto written = nlohmann::json::parse(read_text(folder.path() / "estimate" / name));
    RunOptions again = options;
    again.output = folder.path() / "again";
    again.replace = true;
    again.dhami2020.plots = 0;
    again.boxes = folder.write("map.geojson", as_breeders_map(written).dump());
    const Estimate given = run(again);
    EXPECT_EQ(given.diagnostics["boxes"]["from_degrees"],
              name == std::string("plots.wgs84.geojson"));
    ASSERT_EQ(given.plots.size(), 8u);
    for (std::size_t i = 0; i < given.plots.size(); ++i)
      EXPECT_GT(intersection_over_union(given.plots[i].box, estimate.plots[i].box), 0.999);
    EXPECT_NEAR(given.plots[3].heights_m.at("raw-max"), estimate.plots[3].heights_m.at("raw-max"),
                1e-3);
    expect_breeders_map(again.output);
  }
}

TEST(Run, LeavesNothingBehindOnBadInput) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  const auto message = [&] { return message_of<InputError>([&] { run(options); }); };
  options.method = "magic";
  EXPECT_THAT(message(), HasSubstr("no method \"magic\""));
  options.method = "dhami2020";
  options.dhami2020.plots = 0;
  EXPECT_THAT(message(), HasSubstr("number of plots"));
  options.boxes = folder.write("none.geojson", R"({"features":[]})");
  EXPECT_THAT(message(), HasSubstr("has no plots"));
  options.cloud = folder.path() / "missing.pcd";
  EXPECT_THAT(message(), HasSubstr("missing.pcd"));
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    EXPECT_THAT(entry.path().filename().string(), ::testing::AnyOf("scan", "none.geojson"));
  }
}

}  // namespace
}  // namespace plotscan::estimate
