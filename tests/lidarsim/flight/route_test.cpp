// SPDX-License-Identifier: Apache-2.0
#include "flight/route.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"

namespace plotscan::flight {
namespace {

// 2 m/s^2 and 4 m/s^3: speeding up to v takes v / 2 + 1/2 s, and so does braking.
double straight_s(double distance_m, double speed_m_s) {
  return distance_m / speed_m_s + speed_m_s / 2 + 0.5;
}

TEST(Route, LegsTakeTheirClosedFormTime) {
  const std::vector<Waypoint> waypoints = {
      {.position_m = {0, 0, 10}},
      {.position_m = {30, 0, 10}, .speed_m_s = 4, .hold_s = 7},
      {.position_m = {60, 0, 50}, .speed_m_s = 1},  // 30 m ahead, 40 m up
      {.position_m = {60, 0, 20}}};
  const Route route(Quadrotor(), waypoints, 2);
  // At 4 m/s along 3:4 it would climb 3.2 m/s; the limit is 3.
  EXPECT_NEAR(route.duration_s(), straight_s(30, 2) + 7 + straight_s(50, 3.75) + straight_s(30, 1),
              1e-9);
  double climb = 0;
  double fastest = 0;
  for (double t = 0; t < route.duration_s(); t += 0.01) {
    climb = std::max(climb, route.at(t).velocity_m_s.z());
    fastest = std::max(fastest, route.at(t).velocity_m_s.norm());
  }
  EXPECT_NEAR(climb, 3, 1e-9);
  EXPECT_NEAR(fastest, 3.75, 1e-9);
}

TEST(Route, SinksNoFasterThanItMay) {
  const Route route(Quadrotor(), waypoints_at({{0, 0, 40}, {0, 0, 10}}), 5);
  EXPECT_NEAR(route.duration_s(), straight_s(30, 1.5), 1e-9);
  double fastest = 0;
  for (double t = 0; t < route.duration_s(); t += 0.01)
    fastest = std::max(fastest, -route.at(t).velocity_m_s.z());
  EXPECT_NEAR(fastest, 1.5, 1e-9);
}

TEST(Route, NoseIsWhereTheWaypointsSay) {
  const std::vector<Waypoint> waypoints = {
      {.position_m = {0, 0, 5}},   // up: as the next leg
      {.position_m = {0, 0, 10}},  // north
      {.position_m = {0, 20, 10},
       .heading_rad = kPi / 4,
       .hold_s = 3},                 // flies east, nose north-east
      {.position_m = {20, 20, 10}},  // down: nose as it was
      {.position_m = {20, 20, 5}, .heading_rad = kPi, .hold_s = 2}};
  const Route route(Quadrotor(), waypoints, 2);
  EXPECT_NEAR(route.at(1).heading_rad, kPi / 2, 1e-12);
  const auto heading_at = [&](const Eigen::Vector3d& place) {
    for (double t = 0; t < route.duration_s(); t += 0.01) {
      if ((route.at(t).position_m - place).norm() < 0.05) return route.at(t).heading_rad;
    }
    return std::nan("");
  };
  EXPECT_NEAR(heading_at({0, 10, 10}), kPi / 2, 1e-12);
  EXPECT_NEAR(heading_at({10, 20, 10}), kPi / 4, 1e-12);
  EXPECT_NEAR(heading_at({20, 20, 7}), kPi / 4, 1e-12);
  EXPECT_NEAR(std::cos(route.at(route.duration_s()).heading_rad), -1, 1e-12);
}

TEST(Route, PassesAndWaitsAtEveryWaypoint) {
  const std::vector<Waypoint> waypoints = {{.position_m = {1, 2, 5}, .hold_s = 2},
                                           {.position_m = {20, -3, 30}, .hold_s = 4},
                                           {.position_m = {20, -3, 12}, .hold_s = 3}};
  const Quadrotor quadrotor;
  const Route route(quadrotor, waypoints, 5);
  const scan::Trajectory flown = fly_exactly(quadrotor, route);
  for (const Waypoint& waypoint : waypoints) {
    double there_s = 0;
    for (const scan::StampedPose& pose : flown.poses())
      if ((pose.position_m - waypoint.position_m).norm() < 1e-9) there_s += 0.01;
    EXPECT_NEAR(there_s, waypoint.hold_s, 0.1);
  }
  for (const scan::StampedPose& pose : flown.poses()) {
    const double up = (pose.attitude * Eigen::Vector3d::UnitZ()).z();
    ASSERT_GE(up, std::cos(quadrotor.max_tilt_rad));
  }
}

TEST(Route, AHeadwindLeavesLessAcceleration) {
  const MotionLimits still = leg_limits(Quadrotor(), 2);
  EXPECT_EQ(still.acceleration, 2);
  const MotionLimits windy = leg_limits(Quadrotor(), 2, 5);
  EXPECT_NEAR(windy.acceleration, 9.80665 * std::tan(0.5) - 0.12 * 49 / 1.477, 1e-12);
}

TEST(Route, ImpossibleSpeedsAreRefused) {
  EXPECT_THROW(Route(Quadrotor(), {{.position_m = {0, 0, 5}, .speed_m_s = 7}, {}}, 2), InputError);
}

}  // namespace
}  // namespace plotscan::flight
