// SPDX-License-Identifier: Apache-2.0
// Every shipped sensor flown over flat ground with the default mount.
#include <algorithm>
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "core/manifest.h"
#include "lidar/fly.h"
#include "record/scan_folder.h"
#include "scan/cloud_reader.h"
#include "sensor/sensor.h"
#include "sensor/summary.h"
#include "small_farm.h"
#include "temporary_folder.h"

namespace plotscan::lidar {
namespace {

constexpr double kGround_m = 1.5;
constexpr double kAltitude_m = 8;
constexpr double kHalfSide_m = 40;

farm::Farm level_farm() {
  return {.name = "flat",
          .terrain = testing::flat_terrain(kHalfSide_m, kGround_m),
          .models = {},
          .plots = {},
          .plants = {}};
}

struct Footprint {
  std::size_t points = 0;
  double least_x = 1e9;
  double most_x = -1e9;
  double most_y = 0;
  double height_error_m = 0;
};

Footprint footprint_of(const std::filesystem::path& cloud) {
  Footprint footprint;
  scan::read_positions(cloud, [&](std::span<const Eigen::Vector3d> points) {
    for (const Eigen::Vector3d& point : points) {
      footprint.least_x = std::min(footprint.least_x, point.x());
      footprint.most_x = std::max(footprint.most_x, point.x());
      footprint.most_y = std::max(footprint.most_y, std::abs(point.y()));
      footprint.height_error_m =
          std::max(footprint.height_error_m, std::abs(point.z() - kGround_m));
    }
    footprint.points += points.size();
  });
  return footprint;
}

// Hovers for 0.3 s, three turns, nose to the east.
FlySummary hover(const testing::TemporaryFolder& folder, const std::string& sensor) {
  const auto flight = folder.write("flight.tum", "0 0 0 9.5 0 0 0 1\n0.3 0 0 9.5 0 0 0 1\n");
  return fly(level_farm(), folder.path() / sensor,
             {.sensor = sensor, .flight = flight, .range_noise_m = 0});
}

TEST(Sensors, ScanTheGroundBelow) {
  const testing::TemporaryFolder folder;
  for (const std::string& name : sensor::sensor_names()) {
    const FlySummary summary = hover(folder, name);
    const sensor::Sensor sensor = sensor::load_sensor(name);
    const nlohmann::json figures = summary_json(sensor);
    EXPECT_NEAR(static_cast<double>(summary.shots), 0.3 * figures["shots_per_second"].get<double>(),
                70)
        << name;
    const Footprint footprint = footprint_of(folder.path() / name / "cloud.pcd");
    EXPECT_EQ(footprint.points, summary.points);
    // A range is at most half a step off.
    EXPECT_LT(footprint.height_error_m, 0.5 * sensor.range_step_m + 1e-4) << name;
    if (sensor.wedges) {
      const double radius_m = kAltitude_m * std::tan(radians(19.2));
      EXPECT_EQ(summary.points, summary.shots);
      EXPECT_NEAR(footprint.most_x, radius_m, 0.05);
      EXPECT_NEAR(footprint.least_x, -radius_m, 0.05);
      EXPECT_NEAR(footprint.most_y, radius_m, 0.05);
      continue;
    }
    // Across the track as far as the ground goes, or near it; the lowest laser looks back.
    EXPECT_GT(footprint.most_y, 0.9 * kHalfSide_m) << name;
    const std::array<double, 2> elevation_deg = figures["elevation_deg"];
    EXPECT_LT(footprint.least_x, -kAltitude_m * std::tan(radians(-elevation_deg[0])) + 0.1) << name;
    EXPECT_GT(footprint.most_x, kAltitude_m * std::tan(radians(elevation_deg[1])) - 0.1) << name;
    EXPECT_GT(static_cast<double>(summary.points), 0.35 * static_cast<double>(summary.shots))
        << name;
  }
}

TEST(Sensors, ARisleyScannerHasNoSpinAndIsReadBack) {
  const testing::TemporaryFolder folder;
  const FlySummary summary = hover(folder, "livox_mid40");
  const auto scan = folder.path() / "livox_mid40";
  EXPECT_FALSE(read_manifest(scan)["options"].contains("spin_hz"));
  const record::FlightRecord flight = record::read_flight_record(scan);
  EXPECT_EQ(flight.spin_hz, 0);
  EXPECT_EQ(flight.placed().sequences() * flight.placed().lasers(), summary.shots);
  EXPECT_THAT(testing::message_of<InputError>([&] {
                fly(level_farm(), folder.path() / "refused",
                    {.sensor = "livox_mid40", .spin_hz = 10});
              }),
              ::testing::HasSubstr("sensor livox_mid40 does not spin; leave out --spin"));
  EXPECT_FALSE(exists(folder.path() / "refused"));
}

TEST(Sensors, ScansAreTheSameForAnyNumberOfThreads) {
  const testing::TemporaryFolder folder;
  const farm::Farm farm = testing::small_farm();
  const auto flight = folder.write("flight.tum", "0 -3 0 5 0 0 0 1\n0.2 3 0 5 0.1 0 0 0.995\n");
  for (const std::string name : {"os1_64", "livox_mid40"}) {
    const auto cloud = [&](int threads) {
      const auto scan = folder.path() / (name + std::to_string(threads));
      fly(farm, scan, {.sensor = name, .flight = flight, .threads = threads});
      return read_text(scan / "cloud.pcd");
    };
    const std::string one = cloud(1);
    EXPECT_TRUE(one == cloud(2)) << name;
    EXPECT_TRUE(one == cloud(5)) << name;
  }
}

}  // namespace
}  // namespace plotscan::lidar
