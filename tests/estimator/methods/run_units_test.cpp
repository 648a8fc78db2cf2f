// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
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
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::kFarm;
using testing::small_run;
using testing::write_cloud;

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
  const estimate::Estimate read = estimate::read_estimate(folder);
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
  metres.crop_box = cloud::Area{-30, -30, 30, 30};
  feet.crop_box = cloud::Area{low.x() / kFoot, low.y() / kFoot, high.x() / kFoot, high.y() / kFoot};
  const estimate::Estimate expected = run(metres);
  const estimate::Estimate found = run(feet);
  ASSERT_EQ(found.plots.size(), expected.plots.size());
  EXPECT_NEAR(found.plots[3].heights_m.at("raw-max"), expected.plots[3].heights_m.at("raw-max"),
              1e-3);
  EXPECT_NEAR(found.plots[3].box.length_m, expected.plots[3].box.length_m, 0.05);
  EXPECT_LT(
      (first_corner(feet.output) * kFoot - moved.head<2>() - first_corner(metres.output)).norm(),
      0.1);
  EXPECT_THAT(found.diagnostics.notes.value(),
              Contains(HasSubstr("US survey feet are converted to metres")));
  const estimate::Estimate read = estimate::read_estimate(feet.output);
  ASSERT_TRUE(read.units);
  EXPECT_LT((read.plots[3].box.center - found.plots[3].box.center).norm(), 1e-6);

  auto turned = nlohmann::json::parse(read_text(feet.output / "plots.geojson"));
  turned["coordinate_units_m"]["x_y"] = -1;
  const fs::path backwards = folder.write("backwards.geojson", turned.dump());
  EXPECT_THAT(message_of<InputError>([&] { estimate::read_estimate(backwards); }),
              HasSubstr("x_y and z must be metres above 0"));

  // A breeder's map, drawn over the cloud in a GIS, is in its feet.
  auto map = nlohmann::json::parse(read_text(feet.output / "plots.geojson"));
  map.erase("coordinate_units_m");
  feet.boxes = folder.write("map.geojson", as_breeders_map(map).dump());
  feet.dhami2020.plots = 0;
  feet.replace = true;
  const estimate::Estimate given = run(feet);
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
  const estimate::Estimate expected = run(whole);
  const estimate::Estimate found = run(tiles);
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
    text += format_number(3 + point.x() / (111320 * std::cos(radians(kLat)))) + " " +
            format_number(kLat + point.y() / 111200) + " " + format_number(point.z()) + "\n";
  }
  RunOptions options = small_run(folder, kFarm);
  options.cloud = folder.write("degrees.txt", text);
  const estimate::Estimate estimate = run(options);
  EXPECT_EQ(estimate.plots.size(), 8u);
  EXPECT_EQ(estimate.crs, "EPSG:32631");
  EXPECT_NEAR(first_corner(options.output).x(), 500000, 50);
  EXPECT_NEAR(first_corner(options.output).y(), 5316300, 500);
  EXPECT_THAT(estimate.diagnostics.notes.value(), Contains(HasSubstr("zone 31N")));

  // Its plots in degrees are a map as any breeder's; so are those in the zone's metres.
  for (const char* const name : {"plots.wgs84.geojson", "plots.geojson"}) {
    const auto written = nlohmann::json::parse(read_text(folder.path() / "estimate" / name));
    RunOptions again = options;
    again.output = folder.path() / "again";
    again.replace = true;
    again.dhami2020.plots = 0;
    again.boxes = folder.write("map.geojson", as_breeders_map(written).dump());
    const estimate::Estimate given = run(again);
    EXPECT_EQ(given.diagnostics.boxes.value().from_degrees,
              name == std::string("plots.wgs84.geojson"));
    ASSERT_EQ(given.plots.size(), 8u);
    for (std::size_t i = 0; i < given.plots.size(); ++i)
      EXPECT_GT(intersection_over_union(given.plots[i].box, estimate.plots[i].box), 0.999);
    EXPECT_NEAR(given.plots[3].heights_m.at("raw-max"), estimate.plots[3].heights_m.at("raw-max"),
                1e-3);
    expect_breeders_map(again.output);
  }
}

// A silent cloud on the meridian of zone 31, 1 km north of the equator: latitudes are metres over
// the meridian's radius of curvature there and 0.9996.
TEST(Run, AGivenSystemGoesIntoTheResults) {
  const TemporaryFolder folder;
  std::string text;
  const Eigen::Vector3d moved(500000, 1000, 0);
  for (const Eigen::Vector3d& point : kFarm.points()) {
    const Eigen::Vector3d utm = point + moved;
    text +=
        format_number(utm.x()) + " " + format_number(utm.y()) + " " + format_number(utm.z()) + "\n";
  }
  RunOptions options = small_run(folder, kFarm);
  options.cloud = folder.write("utm.xyz", text);
  options.cloud.crs = "EPSG:32631";
  const estimate::Estimate estimate = run(options);
  const auto named = nlohmann::json::parse(read_text(options.output / "plots.geojson"));
  EXPECT_EQ(named["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::32631");
  EXPECT_EQ(read_manifest(options.output)["options"]["crs"], "EPSG:32631");
  const auto degrees = nlohmann::json::parse(read_text(options.output / "plots.wgs84.geojson"));
  constexpr double kSemiMajor_m = 6378137;
  constexpr double kEccentricity2 = 0.00669437999014;
  const Eigen::Vector2d corner = first_corner(options.output);
  const auto& lonlat = degrees["features"][0]["geometry"]["coordinates"][0][0];
  EXPECT_NEAR(lonlat[0].get<double>(), 3 + (corner.x() - 500000) / 0.9996 / kSemiMajor_m / kDegrees,
              1e-9);
  EXPECT_NEAR(lonlat[1].get<double>(),
              corner.y() / 0.9996 / (kSemiMajor_m * (1 - kEccentricity2)) / kDegrees, 1e-9);
}

}  // namespace
}  // namespace plotscan::methods
