// SPDX-License-Identifier: Apache-2.0
#include "flight/route.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/error.h"
#include "core/list_of.h"

namespace plotscan::flight {
namespace {

double wrap_angle(double angle_rad) { return std::remainder(angle_rad, 2 * kPi); }

// The heading of a nose that points along the way; absent if the way is vertical.
std::optional<double> heading_along(const Eigen::Vector3d& way) {
  if (way.head<2>().norm() <= 1e-9 * way.norm()) return std::nullopt;
  return std::atan2(way.y(), way.x());
}

std::optional<double> heading_from(const std::vector<Waypoint>& waypoints, std::size_t i) {
  if (waypoints[i].heading_rad) return waypoints[i].heading_rad;
  if (i + 1 == waypoints.size()) return std::nullopt;
  return heading_along(waypoints[i + 1].position_m - waypoints[i].position_m);
}

double first_heading(const std::vector<Waypoint>& waypoints) {
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    if (const auto heading = heading_from(waypoints, i)) return *heading;
  }
  return 0;
}

MotionLimits limits_along(const Quadrotor& quadrotor, const Eigen::Vector3d& way, double speed_m_s,
                          double wind_m_s) {
  MotionLimits limits = leg_limits(quadrotor, speed_m_s, wind_m_s);
  const double steepness = std::abs(way.z()) / way.norm();
  const double vertical = way.z() > 0 ? quadrotor.max_climb_m_s : quadrotor.max_descent_m_s;
  if (steepness * limits.speed > vertical) limits.speed = vertical / steepness;
  return limits;
}

}  // namespace

std::vector<Waypoint> waypoints_at(const std::vector<Eigen::Vector3d>& positions_m) {
  return list_of(positions_m,
                 [](const auto& position) { return Waypoint{.position_m = position}; });
}

Route::Route(const Quadrotor& quadrotor, const std::vector<Waypoint>& waypoints, double speed_m_s,
             double wind_m_s) {
  check(waypoints.size() >= 2, "a flight has at least two waypoints");
  double heading = first_heading(waypoints);
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const Eigen::Vector3d way = waypoints[i + 1].position_m - waypoints[i].position_m;
    check(way.norm() > 0, "waypoints are apart");
    const double next_heading = heading_from(waypoints, i).value_or(heading);
    add_leg(quadrotor, waypoints[i], way, heading, next_heading,
            limits_along(quadrotor, way, waypoints[i].speed_m_s.value_or(speed_m_s), wind_m_s));
    heading = next_heading;
  }
  const Waypoint& last = waypoints.back();
  if (last.heading_rad || last.hold_s > 0) {
    add_leg(quadrotor, last, Eigen::Vector3d::Zero(), heading, last.heading_rad.value_or(heading),
            leg_limits(quadrotor, speed_m_s, wind_m_s));
  }
}

void Route::add_leg(const Quadrotor& quadrotor, const Waypoint& from, const Eigen::Vector3d& way,
                    double heading_before_rad, double heading_rad, const MotionLimits& limits) {
  const double turn = wrap_angle(heading_rad - heading_before_rad);
  legs_.push_back({.start = from.position_m,
                   .direction = way.normalized(),
                   .heading_before_rad = heading_before_rad,
                   .turn_rad = turn,
                   .hold_s = from.hold_s,
                   .turn = RestToRest(std::abs(turn), quadrotor.turn),
                   .flight = RestToRest(way.norm(), limits),
                   .begin_s = duration_s_});
  duration_s_ += legs_.back().duration_s();
}

Reference Route::at(double time_s) const {
  const auto after = std::ranges::upper_bound(legs_, time_s, {}, &Leg::begin_s);
  const Leg& leg = after == legs_.begin() ? legs_.front() : *std::prev(after);
  const double in_leg_s = time_s - leg.begin_s;
  const RestToRest::State turn = leg.turn.at(in_leg_s);
  const RestToRest::State flight = leg.flight.at(in_leg_s - leg.turn.duration_s() - leg.hold_s);
  return {.position_m = leg.start + flight.distance * leg.direction,
          .velocity_m_s = flight.speed * leg.direction,
          .acceleration_m_s2 = flight.acceleration * leg.direction,
          .heading_rad = leg.heading_before_rad + std::copysign(turn.distance, leg.turn_rad)};
}

scan::Trajectory fly_exactly(const Quadrotor& quadrotor, const Route& route) {
  const auto steps = static_cast<std::uint64_t>(std::ceil(route.duration_s() * kPosesPerSecond));
  std::vector<scan::StampedPose> poses;
  poses.reserve(steps + 1);
  for (std::uint64_t step = 0; step <= steps; ++step) {
    const double time_s = static_cast<double>(step) / kPosesPerSecond;
    const Reference reference = route.at(time_s);
    poses.push_back({.time_s = time_s,
                     .position_m = reference.position_m,
                     .attitude = attitude_for(quadrotor, reference.acceleration_m_s2,
                                              reference.velocity_m_s, reference.heading_rad)});
  }
  return scan::Trajectory(std::move(poses));
}

}  // namespace plotscan::flight
