// SPDX-License-Identifier: Apache-2.0
#include "core/geodesy.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../example_farm.h"
#include "core/angle.h"
#include "core/error.h"
#include "core/plot_features.h"
#include "description/load_description.h"
#include "farmfolder/read_farm.h"
#include "farmfolder/write_farm.h"
#include "planting/generate.h"

namespace plotscan::farmfolder {
namespace {

using nlohmann::json;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

// WGS84: semi-major axis and flattening (NIMA TR8350.2, table 3.1).
constexpr double kA_m = 6378137.0;
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kE2 = kFlattening * (2 - kFlattening);

double normal_radius_m(double latitude_rad) {
  return kA_m / std::sqrt(1 - kE2 * std::pow(std::sin(latitude_rad), 2));
}

double meridian_radius_m(double latitude_rad) {
  return kA_m * (1 - kE2) / std::pow(1 - kE2 * std::pow(std::sin(latitude_rad), 2), 1.5);
}

// Earth-centred coordinates by the closed form (Hofmann-Wellenhof et al., GPS, section 10.2.1).
Eigen::Vector3d earth_centred(const GeodeticPoint& point) {
  const double latitude = point.latitude_deg * kDegrees;
  const double longitude = point.longitude_deg * kDegrees;
  const double n = normal_radius_m(latitude);
  const double across = (n + point.altitude_m) * std::cos(latitude);
  return {across * std::cos(longitude), across * std::sin(longitude),
          ((1 - kE2) * n + point.altitude_m) * std::sin(latitude)};
}

// Columns: east, north and up at the place.
Eigen::Matrix3d east_north_up(const GeodeticPoint& point) {
  return (Eigen::AngleAxisd((point.longitude_deg + 90) * kDegrees, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd((90 - point.latitude_deg) * kDegrees, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

constexpr Anchor kAnchors[] = {
    {37.2, -80.58, 620}, {-33.9, 151.2, 12.5}, {52.5, 179.99995, 0}, {0, 0, 0}, {-89, -180, 2800}};

TEST(Geodesy, PointsLieWhereTheClosedFormThroughTheEarthsCentrePutsThem) {
  for (const Anchor& anchor : kAnchors) {
    for (const Eigen::Vector3d& point : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(40, -25, 1.5),
                                         Eigen::Vector3d(-900, 2000, 80)}) {
      const GeodeticPoint geodetic = geodetic_from_world(anchor, point);
      const Eigen::Vector3d expected = earth_centred(anchor) + east_north_up(anchor) * point;
      EXPECT_LT((earth_centred(geodetic) - expected).norm(), 1e-7) << point.transpose();
      EXPECT_LT(std::abs(geodetic.longitude_deg - anchor.longitude_deg), 1) << "in one piece";
    }
  }
}

TEST(Geodesy, MetresOfADegreeAreTheEllipsoids) {
  const Anchor anchor{.latitude_deg = 45, .longitude_deg = 7, .altitude_m = 0};
  const double latitude = 45 * kDegrees;
  const GeodeticPoint north = geodetic_from_world(anchor, {0, 1, 0});
  EXPECT_NEAR(1 / (north.latitude_deg - 45), meridian_radius_m(latitude) * kDegrees, 0.02);
  // The published lengths of a degree at 45 degrees.
  EXPECT_NEAR(1 / (north.latitude_deg - 45), 111131.8, 0.1);
  const GeodeticPoint east = geodetic_from_world(anchor, {1, 0, 0});
  EXPECT_NEAR(1 / (east.longitude_deg - 7), 78846.8, 0.1);
  EXPECT_NEAR(geodetic_from_world(anchor, {0, 0, 3}).altitude_m, 3, 1e-8);
}

farm::Farm anchored_example(const TemporaryFolder& folder) {
  const planting::FarmDescription description = description::load_description(
      write_example(folder),
      {"anchor.latitude_deg=37.2", "anchor.altitude_m=620", "anchor.longitude_deg=-80.58"});
  farm::Farm farm = planting::generate(description, 42);
  write_farm(farm, folder.path() / "farm", {.command = "farmgen generate"});
  return farm;
}

double signed_area(const json& ring) {
  double twice = 0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    twice += ring[i][0].get<double>() * ring[i + 1][1].get<double>() -
             ring[i + 1][0].get<double>() * ring[i][1].get<double>();
  }
  return twice / 2;
}

TEST(Geodesy, AnAnchoredFarmHasItsPlotsInWgs84AsWell) {
  const TemporaryFolder folder;
  const farm::Farm farm = anchored_example(folder);
  const auto truth = folder.path() / "farm" / "truth";
  const json local = json::parse(read_text(truth / "plots.geojson"));
  const json wgs84 = json::parse(read_text(truth / "plots_wgs84.geojson"));
  EXPECT_THAT(local["coordinate_system"].get<std::string>(), HasSubstr("local metres"));
  EXPECT_THAT(wgs84["coordinate_system"].get<std::string>(), HasSubstr("WGS84"));
  ASSERT_EQ(wgs84["features"].size(), farm.plots.size());
  const double latitude = 37.2 * kDegrees;
  for (std::size_t i = 0; i < farm.plots.size(); ++i) {
    EXPECT_EQ(wgs84["features"][i]["properties"], local["features"][i]["properties"]);
    const json& ring = wgs84["features"][i]["geometry"]["coordinates"][0];
    const json& ring_m = local["features"][i]["geometry"]["coordinates"][0];
    ASSERT_EQ(ring.size(), 5u);
    EXPECT_EQ(ring.front(), ring.back());
    // The shoelace of degrees is the area but for the metres of a degree; anticlockwise is
    // positive.
    const Eigen::Vector2d degree_m =
        Eigen::Vector2d((normal_radius_m(latitude) + 620) * std::cos(latitude),
                        meridian_radius_m(latitude) + 620) *
        kDegrees;
    EXPECT_NEAR(signed_area(json(ring)) * degree_m.prod(), farm.plots[i].box.area_m2(), 0.01);
    for (std::size_t corner = 0; corner < 5; ++corner) {
      EXPECT_NEAR((ring[corner][0].get<double>() + 80.58) * degree_m.x(),
                  ring_m[corner][0].get<double>(), 1e-3);
      EXPECT_NEAR((ring[corner][1].get<double>() - 37.2) * degree_m.y(),
                  ring_m[corner][1].get<double>(), 1e-3);
    }
  }
}

TEST(Geodesy, TheAnchorIsReadBackAndAFarmWithoutOneHasNone) {
  const TemporaryFolder folder;
  anchored_example(folder);
  const farm::Farm read = read_farm(folder.path() / "farm");
  ASSERT_TRUE(read.anchor);
  EXPECT_EQ(read.anchor->latitude_deg, 37.2);
  EXPECT_EQ(read.anchor->longitude_deg, -80.58);
  EXPECT_EQ(read.anchor->altitude_m, 620);
  const farm::Farm bare =
      planting::generate(description::load_description(write_example(folder)), 42);
  write_farm(bare, folder.path() / "bare", {.command = "farmgen generate"});
  EXPECT_FALSE(read_farm(folder.path() / "bare").anchor);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "bare/truth/plots_wgs84.geojson"));
}

TEST(Geodesy, DegreesAreNotTakenForMetres) {
  const TemporaryFolder folder;
  anchored_example(folder);
  EXPECT_THAT(message_of<InputError>(
                  [&] { read_plot_features(folder.path() / "farm/truth/plots_wgs84.geojson"); }),
              HasSubstr("longitude and latitude"));
}

TEST(Geodesy, AnchorsOffTheEarthAreRefused) {
  const TemporaryFolder folder;
  const auto message = [&](const std::vector<std::string>& overrides) {
    return message_of<InputError>(
        [&] { description::load_description(write_example(folder), overrides); });
  };
  EXPECT_THAT(message({"anchor.latitude_deg=91", "anchor.longitude_deg=0"}),
              HasSubstr("anchor.latitude_deg 91 is not in [-89, 89]"));
  EXPECT_THAT(message({"anchor.latitude_deg=1", "anchor.longitude_deg=200"}),
              HasSubstr("anchor.longitude_deg 200 is not in [-180, 180]"));
  EXPECT_THAT(message({"anchor.latitude_deg=1"}), HasSubstr("anchor.longitude_deg is missing"));
  EXPECT_THAT(message({"anchor.latitude_deg=1", "anchor.longitude_deg=2", "anchor.lat=1"}),
              HasSubstr("anchor.lat is not a known key"));
}

}  // namespace
}  // namespace plotscan::farmfolder
