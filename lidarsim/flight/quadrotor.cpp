// SPDX-License-Identifier: Apache-2.0
#include "flight/quadrotor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/csv.h"
#include "core/error.h"

namespace plotscan::flight {
namespace {

constexpr double kPosesPerSecond = 100;

// A turn on the spot, then a straight leg.
struct Leg {
  Eigen::Vector3d start;
  Eigen::Vector3d direction;  // unit vector
  double heading_before_rad = 0;
  double turn_rad = 0;  // counter-clockwise
  RestToRest turn;
  RestToRest flight;

  double duration_s() const { return turn.duration_s() + flight.duration_s(); }
};

double wrap_angle(double angle_rad) { return std::remainder(angle_rad, 2 * std::numbers::pi); }

std::vector<Leg> legs_between(const Quadrotor& quadrotor,
                              const std::vector<Eigen::Vector3d>& waypoints, double speed_m_s) {
  const MotionLimits limits = leg_limits(quadrotor, speed_m_s);
  std::vector<Leg> legs;
  double heading = 0;
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const Eigen::Vector3d way = waypoints[i + 1] - waypoints[i];
    check(way.norm() > 0 && way.z() == 0, "waypoints are apart and level");
    const double next_heading = std::atan2(way.y(), way.x());
    if (i == 0) heading = next_heading;
    const double turn = wrap_angle(next_heading - heading);
    legs.push_back({.start = waypoints[i],
                    .direction = way.normalized(),
                    .heading_before_rad = heading,
                    .turn_rad = turn,
                    .turn = RestToRest(std::abs(turn), quadrotor.turn),
                    .flight = RestToRest(way.norm(), limits)});
    heading = next_heading;
  }
  return legs;
}

scan::StampedPose pose_in_leg(const Quadrotor& quadrotor, const Leg& leg, double in_leg_s) {
  const RestToRest::State turn = leg.turn.at(in_leg_s);
  const RestToRest::State flight = leg.flight.at(in_leg_s - leg.turn.duration_s());
  const double heading = leg.heading_before_rad + std::copysign(turn.distance, leg.turn_rad);
  return {.position_m = leg.start + flight.distance * leg.direction,
          .attitude = attitude_for(quadrotor, flight.acceleration * leg.direction,
                                   flight.speed * leg.direction, heading)};
}

}  // namespace

Eigen::Quaterniond attitude_for(const Quadrotor& quadrotor, const Eigen::Vector3d& acceleration,
                                const Eigen::Vector3d& velocity, double heading_rad) {
  const Eigen::Vector3d drag = -quadrotor.drag_n_s2_m2 * velocity.norm() * velocity;
  const Eigen::Vector3d thrust_per_mass =
      acceleration + kGravity_m_s2 * Eigen::Vector3d::UnitZ() - drag / quadrotor.mass_kg;
  const Eigen::Vector3d nose(std::cos(heading_rad), std::sin(heading_rad), 0);
  Eigen::Matrix3d world_from_body;
  world_from_body.col(2) = thrust_per_mass.normalized();
  world_from_body.col(1) = world_from_body.col(2).cross(nose).normalized();
  world_from_body.col(0) = world_from_body.col(1).cross(world_from_body.col(2));
  return Eigen::Quaterniond(world_from_body);
}

// Slower, a flight over the smallest farm takes hours.
constexpr double kMinSpeed_m_s = 0.01;

MotionLimits leg_limits(const Quadrotor& quadrotor, double speed_m_s) {
  if (!(speed_m_s >= kMinSpeed_m_s && speed_m_s <= quadrotor.max_speed_m_s)) {
    throw InputError("speed " + format_number(speed_m_s) + " m/s must be in [" +
                     format_number(kMinSpeed_m_s) + ", " + format_number(quadrotor.max_speed_m_s) +
                     "] m/s");
  }
  const double against_drag = quadrotor.drag_n_s2_m2 * speed_m_s * speed_m_s / quadrotor.mass_kg;
  const double by_tilt = kGravity_m_s2 * std::tan(quadrotor.max_tilt_rad) - against_drag;
  check(by_tilt > 0, "the quadrotor's tilt holds its top speed");
  return {.speed = speed_m_s,
          .acceleration = std::min(quadrotor.acceleration_m_s2, by_tilt),
          .jerk = quadrotor.jerk_m_s3};
}

scan::Trajectory fly_waypoints(const Quadrotor& quadrotor,
                               const std::vector<Eigen::Vector3d>& waypoints, double speed_m_s) {
  check(waypoints.size() >= 2, "a flight has at least two waypoints");
  const std::vector<Leg> legs = legs_between(quadrotor, waypoints, speed_m_s);
  double duration_s = 0;
  for (const Leg& leg : legs) duration_s += leg.duration_s();
  const auto steps = static_cast<std::uint64_t>(std::ceil(duration_s * kPosesPerSecond));
  std::vector<scan::StampedPose> poses;
  std::size_t current = 0;
  double leg_start_s = 0;
  for (std::uint64_t step = 0; step <= steps; ++step) {
    const double time_s = static_cast<double>(step) / kPosesPerSecond;
    while (current + 1 < legs.size() && time_s >= leg_start_s + legs[current].duration_s())
      leg_start_s += legs[current++].duration_s();
    poses.push_back(pose_in_leg(quadrotor, legs[current], time_s - leg_start_s));
    poses.back().time_s = time_s;
  }
  return scan::Trajectory(std::move(poses));
}

}  // namespace plotscan::flight
