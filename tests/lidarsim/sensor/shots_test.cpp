// SPDX-License-Identifier: Apache-2.0
#include "sensor/shots.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/angle.h"

namespace plotscan::sensor {
namespace {

// The VLP-16 user manual's tables, typed here anew: elevation and vertical correction by laser id.
constexpr double kElevation_deg[16] = {-15, 1, -13, 3,  -11, 5,  -9, 7,
                                       -7,  9, -5,  11, -3,  13, -1, 15};
constexpr double kCorrection_mm[16] = {11.2, -0.7, 9.7, -2.2, 8.1, -3.7, 6.6, -5.1,
                                       5.1,  -6.6, 3.7, -8.1, 2.2, -9.7, 0.7, -11.2};

struct ManualShot {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

// A shot by the manual's formulae: time offset, azimuth, and spherical to Cartesian coordinates.
// There, x = R cos(elevation) sin(azimuth), y = R cos(elevation) cos(azimuth) with y forward; here
// x is forward and y to the left.
ManualShot plain_shot(std::uint64_t shot, double spin_hz, const Eigen::Isometry3d& body_from_lidar,
                      const scan::Trajectory& trajectory) {
  const std::uint64_t laser = shot % 16;
  const double time_s =
      55.296e-6 * static_cast<double>(shot / 16) + 2.304e-6 * static_cast<double>(laser);
  const double azimuth = radians(std::fmod(360 * spin_hz * time_s, 360));
  const double elevation = radians(kElevation_deg[laser]);
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
    const ManualShot expected = plain_shot(shot, spin_hz, body_from_lidar, trajectory);
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

// Beams askew to the head and off its axis, several at once, locked to the azimuth.
constexpr const char* kAskew = R"(name: askew
title: A made-up sensor
kind: spinning
range: {least_m: 0.5, most_m: 50}
spin_hz: {least: 5, most: 20, default: 10}
columns_per_turn: 500
lasers:
  - {fires_us: 0, elevation_deg: 20, azimuth_deg: 3, radius_mm: 15, offset_mm: -4}
  - {fires_us: 0, elevation_deg: -10, azimuth_deg: -2, radius_mm: 15}
  - {fires_us: 40, elevation_deg: 5, radius_mm: -7}
sources: ["made up"]
)";

TEST(Shots, BeamsAskewAndLockedToTheAzimuth) {
  constexpr double kAskewElevation_deg[] = {20, -10, 5};
  constexpr double kAskewAzimuth_deg[] = {3, -2, 0};
  const Eigen::Vector3d askew_origin_m[] = {{0.015, 0, -0.004}, {0.015, 0, 0}, {-0.007, 0, 0}};
  constexpr double kAskewFires_s[] = {0, 0, 40e-6};
  constexpr double kSpin_hz = 8;
  const scan::Trajectory trajectory = tumbling(0.01, 0.02);
  const Eigen::Isometry3d mount = tilted_mount();
  const ShotPlan plan(parse_sensor(kAskew, "askew.yaml"), kSpin_hz, mount, trajectory);
  EXPECT_NEAR(static_cast<double>(plan.sequences()), 0.59 * 8 * 500, 1);
  SequenceShots fired;
  for (std::uint64_t column = 0; column < plan.sequences(); ++column) {
    plan.fire(column, fired);
    for (std::size_t k = 0; k < 3; ++k) {
      const double time_s = static_cast<double>(column) / (kSpin_hz * 500) + kAskewFires_s[k];
      ASSERT_NEAR(plan.time_s(column, k), time_s, 1e-12);
      const Eigen::Isometry3d world_from_lidar =
          trajectory.world_from_body(trajectory.start_s() + time_s) * mount;
      // Clockwise from above, hence the minus.
      const auto about_z = [](double angle_deg) {
        return Eigen::AngleAxisd(-radians(angle_deg), Eigen::Vector3d::UnitZ());
      };
      const double head_deg = std::fmod(360 * kSpin_hz * time_s, 360);
      const double elevation = radians(kAskewElevation_deg[k]);
      const Eigen::Vector3d origin = world_from_lidar * (about_z(head_deg) * askew_origin_m[k]);
      const Eigen::Vector3d direction =
          world_from_lidar.linear() *
          (about_z(head_deg + kAskewAzimuth_deg[k]) *
           Eigen::Vector3d(std::cos(elevation), 0, std::sin(elevation)));
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_NEAR(fired.origin_m[axis][static_cast<Eigen::Index>(k)], origin[axis], 1e-9);
        ASSERT_NEAR(fired.direction[axis][static_cast<Eigen::Index>(k)], direction[axis], 1e-9);
      }
    }
  }
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
