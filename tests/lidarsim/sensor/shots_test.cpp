// SPDX-License-Identifier: Apache-2.0
#include "sensor/shots.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace plotscan::sensor {
namespace {

constexpr double kPi = std::numbers::pi;

// The VLP-16 user manual's tables, typed here anew: elevation and vertical correction by laser id.
constexpr double kElevation_deg[16] = {-15, 1, -13, 3,  -11, 5,  -9, 7,
                                       -7,  9, -5,  11, -3,  13, -1, 15};
constexpr double kCorrection_mm[16] = {11.2, -0.7, 9.7, -2.2, 8.1, -3.7, 6.6, -5.1,
                                       5.1,  -6.6, 3.7, -8.1, 2.2, -9.7, 0.7, -11.2};

struct PlainShot {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

// A shot by the manual's formulae: time offset, azimuth, and spherical to Cartesian coordinates.
// There, x = R cos(elevation) sin(azimuth), y = R cos(elevation) cos(azimuth) with y forward; here
// x is forward and y to the left.
PlainShot plain_shot(std::uint64_t shot, double spin_hz, const Eigen::Isometry3d& body_from_lidar,
                     const scan::Trajectory& trajectory) {
  const std::uint64_t laser = shot % 16;
  const double time_s =
      55.296e-6 * static_cast<double>(shot / 16) + 2.304e-6 * static_cast<double>(laser);
  const double azimuth = std::fmod(360 * spin_hz * time_s, 360) * kPi / 180;
  const double elevation = kElevation_deg[laser] * kPi / 180;
  const Eigen::Isometry3d world_from_lidar =
      trajectory.world_from_body(trajectory.start_s() + time_s) * body_from_lidar;
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                  -std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  return {.origin = world_from_lidar * Eigen::Vector3d(0, 0, 1e-3 * kCorrection_mm[laser]),
          .direction = world_from_lidar.linear() * direction};
}

void expect_plain(std::uint64_t first, std::uint64_t shots, double spin_hz,
                  const Eigen::Isometry3d& body_from_lidar, const scan::Trajectory& trajectory) {
  const ShotPlan plan(load_sensor("vlp16"), spin_hz, body_from_lidar, trajectory);
  SequenceShots fired;
  for (std::uint64_t shot = first; shot < first + shots; ++shot) {
    if (shot == first || shot % 16 == 0) plan.fire(shot / 16, fired);
    const PlainShot expected = plain_shot(shot, spin_hz, body_from_lidar, trajectory);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_NEAR(fired.direction[axis][shot % 16], expected.direction[axis], 1e-9)
          << "shot " << shot;
      ASSERT_NEAR(fired.origin_m[axis][shot % 16], expected.origin[axis], 1e-9) << "shot " << shot;
    }
  }
}

scan::Trajectory hovering() { return scan::Trajectory({{.time_s = 0}, {.time_s = 1}}); }

// Flies, turns about changing axes and starts at a clock's odd time.
scan::Trajectory tumbling(double pose_gap_s, double turn_rad) {
  std::vector<scan::StampedPose> poses;
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  for (int i = 0; i < 60; ++i) {
    const double t = pose_gap_s * i;
    poses.push_back({.time_s = 5 + t,
                     .position_m = {3 * t, std::sin(t), 8 + 0.1 * std::cos(3 * t)},
                     .attitude = attitude});
    const Eigen::Vector3d axis(std::sin(1.0 * i), std::cos(2.0 * i), 0.5);
    attitude = attitude * Eigen::AngleAxisd(turn_rad, axis.normalized());
  }
  return scan::Trajectory(std::move(poses));
}

Eigen::Isometry3d tilted_mount() {
  Eigen::Isometry3d mount(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()));
  mount.pretranslate(Eigen::Vector3d(0.1, -0.05, -0.2));
  return mount;
}

TEST(Shots, FirstTenThousandAreTheManuals) {
  expect_plain(0, 10000, 10, Eigen::Isometry3d::Identity(), hovering());
}

TEST(Shots, TimesAreTheManuals) {
  const ShotPlan plan(load_sensor("vlp16"), 10, Eigen::Isometry3d::Identity(), hovering());
  for (std::uint64_t shot = 0; shot < 10000; ++shot) {
    const double expected_us =
        static_cast<double>(shot / 16) * 55.296 + static_cast<double>(shot % 16) * 2.304;
    ASSERT_NEAR(1e6 * plan.time_s(shot / 16, shot % 16), expected_us, 1e-6);
  }
  EXPECT_EQ(plan.sequences(), 18084u);  // floor(1 s / 55.296 us)
}

TEST(Shots, AzimuthDoesNotDrift) {
  const scan::Trajectory hour({{.time_s = 0}, {.time_s = 3600}});
  expect_plain(16ull * 65000000, 16 * 100, 20, Eigen::Isometry3d::Identity(), hour);
}

TEST(Shots, EachIsFiredFromThePoseOfItsInstant) {
  expect_plain(0, 160000, 10, tilted_mount(), tumbling(0.01, 0.02));
  expect_plain(0, 160000, 10, tilted_mount(), tumbling(0.01, 0.15));  // 15 rad/s
}

// Poses closer than a firing sequence, and turns too fast for the second-order step.
TEST(Shots, WildTrajectoriesAreExactToo) {
  expect_plain(0, 400, 10, tilted_mount(), tumbling(30e-6, 0.01));
  expect_plain(0, 100000, 10, tilted_mount(), tumbling(0.01, 1.5));
}

TEST(Shots, SensorIsConsistent) {
  const Sensor sensor = load_sensor("vlp16");
  ASSERT_EQ(sensor.lasers.size(), 16u);
  for (std::size_t id = 0; id < 16; ++id) {
    int below = 0;
    for (const double other : kElevation_deg) below += other < kElevation_deg[id] ? 1 : 0;
    EXPECT_EQ(sensor.lasers[id].ring, below);
  }
  EXPECT_NEAR(16 / sensor.sequence_s, 289352, 1);  // shots a second
}

}  // namespace
}  // namespace plotscan::sensor
