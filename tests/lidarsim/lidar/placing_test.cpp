// SPDX-License-Identifier: Apache-2.0
// Rays are cast from where the sensor truly is; points are put where the reported poses say.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "flight/pose_errors.h"
#include "lidar/fly.h"
#include "record/scan_folder.h"
#include "simulated.h"
#include "small_farm.h"
#include "temporary_folder.h"

namespace plotscan::lidar {
namespace {

using Points = std::vector<scan::LabelledPoint>;

constexpr double kSensor_m = 8;

// Over flat ground, noiseless, from a hover; fired with the true mount, placed with the stated one.
Points scan_with(const flight::PoseErrors& errors) {
  const farm::Farm ground{.name = "flat",
                          .seed = 1,
                          .terrain = testing::flat_terrain(200, 0),
                          .models = {},
                          .plots = {},
                          .plants = {}};
  const sensor::Sensor sensor = testing::exact_vlp16();
  const Eigen::Isometry3d mount = testing::spin_along_flight();
  const scan::Trajectory truth = testing::hover({0, 0, kSensor_m}, 0.2);
  const sensor::ShotPlan fired(sensor, 10, flight::true_mount(mount, errors), truth);
  const sensor::ShotPlan placed(sensor, 10, mount, flight::reported_trajectory(truth, errors, 1));
  Points points;
  simulate(Scene(scene_content(ground)), sensor, {.fired = fired, .placed = placed},
           {.range_noise_m = 0, .threads = 2}, [&](std::span<const scan::LabelledPoint> piece) {
             points.insert(points.end(), piece.begin(), piece.end());
           });
  return points;
}

// The sensor is truly turned by R about itself: a point truly at p, seen from the sensor at s, is
// put at s + R^-1 (p - s). So what truly is the plane z = 0 becomes that plane turned by R^-1.
void expect_plane_turned(const Eigen::Vector3d& boresight_rpy_deg, const Eigen::Matrix3d& turn) {
  const Points points = scan_with({.boresight_rpy_deg = boresight_rpy_deg});
  ASSERT_GT(points.size(), 10'000u);
  const Eigen::Vector3d sensor(0, 0, kSensor_m);
  double moved = 0;
  for (const scan::LabelledPoint& point : points) {
    const Eigen::Vector3d seen = testing::position(point) - sensor;
    if (seen.norm() > 100) continue;  // single precision
    ASSERT_NEAR((sensor + turn * seen).z(), 0, 2e-4);
    moved = std::max(moved, (turn * seen - seen).norm());
  }
  EXPECT_GT(moved, 0.1);
}

TEST(Placing, ABoresightErrorOfOneDegreeTurnsTheGroundByOneDegree) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  expect_plane_turned({1, 0, 0}, AngleAxisd(kDegrees, Vector3d::UnitX()).toRotationMatrix());
  expect_plane_turned({0, 1, 0}, AngleAxisd(kDegrees, Vector3d::UnitY()).toRotationMatrix());
}

// Straight below, a roll of 1 degree puts the ground 8 m * tan(1 degree) = 14 cm aside.
TEST(Placing, BoresightMovesTheNadirPointByHeightTimesTangent) {
  const auto nadir = [](const Points& points) {
    const auto below = std::min_element(points.begin(), points.end(), [](auto& a, auto& b) {
      return std::hypot(a.x, a.y) < std::hypot(b.x, b.y);
    });
    return std::hypot(below->x, below->y);
  };
  EXPECT_LT(nadir(scan_with({})), 0.15);  // the laser next to the axis' normal looks 1 degree off
  const Points points = scan_with({.boresight_rpy_deg = {0, 0, 1}});
  for (const scan::LabelledPoint& point : points)
    ASSERT_NEAR(point.z, 0, 2e-5 * std::hypot(point.x, point.y) + 1e-5);  // a yaw keeps the ground
}

TEST(Placing, ALeverArmErrorMovesEveryPointByIt) {
  const Points lifted = scan_with({.lever_arm_m = {0, 0, 0.25}});
  ASSERT_GT(lifted.size(), 10'000u);
  for (const scan::LabelledPoint& point : lifted) ASSERT_NEAR(point.z, -0.25, 1e-3);
  std::map<double, Eigen::Vector3d> exact;
  const auto key = [](const scan::LabelledPoint& p) { return p.time + 10 * p.ring; };
  for (const auto& point : scan_with({})) exact[key(point)] = testing::position(point);
  const Points moved = scan_with({.lever_arm_m = {0.1, -0.2, 0}});
  ASSERT_GT(moved.size(), 10'000u);
  for (const auto& point : moved) {
    if (std::hypot(point.x, point.y) > 150) continue;  // near the edge of the ground
    const auto same_shot = exact.find(key(point));
    ASSERT_NE(same_shot, exact.end());
    ASSERT_TRUE(testing::position(point).isApprox(same_shot->second, 1e-5));  // over flat ground
  }
}

// The scan folder's two trajectories, and its points placed by the reported one.
TEST(Placing, FlightsReportWhatTheyErr) {
  const testing::TemporaryFolder folder;
  const farm::Farm farm = testing::small_farm();
  FlyOptions options{.range_noise_m = 0, .pose_error = "gps", .threads = 2};
  fly(farm, folder.path() / "gps", options);
  options.pose_error = "none";
  fly(farm, folder.path() / "none", options);
  const auto read = [&](const char* scan, const char* file) {
    return scan::read_trajectory(folder.path() / scan / file);
  };
  const auto away = [](const scan::Trajectory& a, const scan::Trajectory& b) {
    return (a.world_from_body(1).translation() - b.world_from_body(1).translation()).norm();
  };
  EXPECT_EQ(away(read("none", "trajectory.csv"), read("none", "poses.csv")), 0);
  EXPECT_EQ(away(read("none", "trajectory.csv"), read("gps", "trajectory.csv")), 0);
  EXPECT_GT(away(read("gps", "trajectory.csv"), read("gps", "poses.csv")), 0.05);
  const record::FlightRecord flight = record::read_flight_record(folder.path() / "gps");
  EXPECT_EQ(away(flight.reported, read("gps", "poses.csv")), 0);
}

}  // namespace
}  // namespace plotscan::lidar
