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

TEST(Run, KeepsTheNamesOfGivenPlots) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  options.dhami2020.plots = 0;
  options.boxes = folder.path() / "plots.geojson";
  write_plot_features(
      *options.boxes,
      {{kFarm.box(1, 2), {{"plot_number", 42}, {"row_number", 2}, {"col_number", 3}}},
       {kFarm.box(0, 0), nlohmann::json::object()}});
  const Estimate estimate = run(options);
  ASSERT_EQ(estimate.plots.size(), 2u);
  EXPECT_EQ(estimate.plots[0].id, 42u);
  EXPECT_EQ(estimate.plots[0].row, 2);
  EXPECT_EQ(estimate.plots[0].column, 3);
  EXPECT_EQ(estimate.plots[1].id, 2u);
  EXPECT_NEAR(estimate.plots[0].heights_m.at("raw-max"), kFarm.height_m(1, 2), 1e-4);
  EXPECT_NEAR(estimate.plots[1].heights_m.at("raw-max"), kFarm.height_m(0, 0), 1e-4);
}

// The corner of the first plot in a plots.geojson.
Eigen::Vector2d first_corner(const fs::path& folder) {
  const auto document = nlohmann::json::parse(read_text(folder / "plots.geojson"));
  const auto& corner = document["features"][0]["geometry"]["coordinates"][0][0];
  return {corner[0].get<double>(), corner[1].get<double>()};
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

  // Boxes drawn over the cloud in a GIS are in its feet.
  feet.boxes = folder.write("drawn.geojson", [&] {
    auto document = nlohmann::json::parse(read_text(feet.output / "plots.geojson"));
    document.erase("coordinate_units_m");
    for (auto& feature : document["features"]) feature["properties"] = {{"plot_number", 5}};
    return document.dump();
  }());
  feet.dhami2020.plots = 0;
  feet.replace = true;
  const Estimate given = run(feet);
  EXPECT_NEAR(given.plots[3].heights_m.at("raw-max"), expected.plots[3].heights_m.at("raw-max"),
              1e-3);
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
