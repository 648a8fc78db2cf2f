// SPDX-License-Identifier: Apache-2.0
#include "flight/quadrotor.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "flight/route.h"
#include "temporary_folder.h"

namespace plotscan::flight {
namespace {

constexpr double kStep_s = 0.01;

double tilt_of(const Eigen::Quaterniond& attitude) {
  return std::acos(std::clamp((attitude * Eigen::Vector3d::UnitZ()).z(), -1.0, 1.0));
}

double heading(const Eigen::Quaterniond& attitude) {
  const Eigen::Vector3d nose = attitude * Eigen::Vector3d::UnitX();
  return std::atan2(nose.y(), nose.x());
}

// Two strips and the way between them.
scan::Trajectory two_strips(double speed_m_s) {
  const Quadrotor quadrotor;
  return fly_exactly(
      quadrotor,
      Route(quadrotor, waypoints_at({{-20, -3, 8}, {20, -3, 8}, {20, 3, 8}, {-20, 3, 8}}),
            speed_m_s));
}

TEST(Quadrotor, LeansAgainstDragAtConstantSpeed) {
  const Quadrotor quadrotor;
  for (const double speed : {0.5, 2.0, 6.0}) {
    const double drag = 0.12 * speed * speed;  // N
    const Eigen::Quaterniond attitude =
        attitude_for(quadrotor, Eigen::Vector3d::Zero(), {0, speed, 0}, 1.5707963267948966);
    EXPECT_NEAR(tilt_of(attitude), std::atan(drag / (1.477 * 9.80665)), 1e-12);
    // Leaning forward: the nose, pointing along +y, is down.
    const Eigen::Vector3d nose = attitude * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(nose.z(), -std::sin(tilt_of(attitude)), 1e-12);
    EXPECT_GT(nose.y(), 0);
  }
}

TEST(Quadrotor, HoversLevel) {
  const Eigen::Quaterniond attitude =
      attitude_for(Quadrotor(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.7);
  EXPECT_NEAR(tilt_of(attitude), 0, 1e-9);
  EXPECT_NEAR(heading(attitude), 0.7, 1e-12);
}

// Newton's second law on the flown path: the thrust that the differences of the positions ask for
// points along body z, at every pose.
TEST(Quadrotor, ThrustFollowsFromTheMotion) {
  const Quadrotor quadrotor;
  for (const double speed : {2.0, 6.0}) {
    const scan::Trajectory trajectory = two_strips(speed);
    const auto& poses = trajectory.poses();
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
      const Eigen::Vector3d velocity =
          (poses[i + 1].position_m - poses[i - 1].position_m) / (2 * kStep_s);
      const Eigen::Vector3d acceleration =
          (poses[i + 1].position_m - 2 * poses[i].position_m + poses[i - 1].position_m) /
          (kStep_s * kStep_s);
      const Eigen::Vector3d thrust = 1.477 * (acceleration + Eigen::Vector3d(0, 0, 9.80665)) +
                                     0.12 * velocity.norm() * velocity;
      const Eigen::Vector3d body_z = poses[i].attitude * Eigen::Vector3d::UnitZ();
      // The jerk steps between two poses: jerk * step / g.
      ASSERT_LT(body_z.cross(thrust.normalized()).norm(), 4 * kStep_s / 9.8) << "pose " << i;
      ASSERT_LE(tilt_of(poses[i].attitude), quadrotor.max_tilt_rad);
      ASSERT_LE(acceleration.norm(), quadrotor.acceleration_m_s2 + 1e-6);
      ASSERT_LE(velocity.norm(), speed + 1e-9);
    }
  }
}

TEST(Quadrotor, CruisesAlongTheStripsNoseAhead) {
  const scan::Trajectory trajectory = two_strips(2);
  int cruising = 0;
  const auto& poses = trajectory.poses();
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const Eigen::Vector3d& p = poses[i].position_m;
    if (std::abs(p.x()) > 18) continue;
    ++cruising;
    const double forth = p.y() < 0 ? 1 : -1;
    ASSERT_NEAR((poses[i + 1].position_m.x() - p.x()) / kStep_s, 2 * forth, 1e-9);
    ASSERT_NEAR(std::cos(heading(poses[i].attitude)), forth, 1e-12);
  }
  EXPECT_NEAR(cruising * kStep_s, 2 * 36 / 2.0, 0.05);
}

TEST(Quadrotor, TurnsAtALimitedRateAndPassesEveryWaypoint) {
  const scan::Trajectory trajectory = two_strips(2);
  const auto& poses = trajectory.poses();
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const double turned =
        std::remainder(heading(poses[i + 1].attitude) - heading(poses[i].attitude), 2 * EIGEN_PI);
    ASSERT_LE(std::abs(turned) / kStep_s, Quadrotor().turn.speed + 1e-9);
  }
  for (const Eigen::Vector3d& waypoint : {Eigen::Vector3d(-20, -3, 8), Eigen::Vector3d(20, -3, 8),
                                          Eigen::Vector3d(20, 3, 8), Eigen::Vector3d(-20, 3, 8)}) {
    double nearest = 1e9;
    for (const scan::StampedPose& pose : poses)
      nearest = std::min(nearest, (pose.position_m - waypoint).norm());
    EXPECT_LT(nearest, 1e-4);
  }
}

TEST(Quadrotor, ImpossibleSpeedsAreRefused) {
  for (const double speed : {0.0, -1.0, 0.001, 6.1, std::nan("")}) {
    const auto fly = [&] { leg_limits(Quadrotor(), speed); };
    EXPECT_THAT(testing::message_of<InputError>(fly),
                ::testing::HasSubstr("must be in [0.01, 6] m/s"));
  }
}

TEST(Quadrotor, LittleTiltMeansLittleAcceleration) {
  const Quadrotor stiff = {.max_tilt_rad = 0.1};
  const MotionLimits limits = leg_limits(stiff, 2);
  EXPECT_NEAR(limits.acceleration, 9.80665 * std::tan(0.1) - 0.12 * 4 / 1.477, 1e-12);
}

}  // namespace
}  // namespace plotscan::flight
