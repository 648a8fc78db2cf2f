// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "flight/quadrotor.h"
#include "flight/rest_to_rest.h"
#include "scan/trajectory.h"

namespace plotscan::flight {

// A place to fly through. Its speed and heading hold from here to the next waypoint.
struct Waypoint {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // world frame
  std::optional<double> speed_m_s = {};                  // absent: the route's speed
  // Heading of the nose, counter-clockwise from east. Absent: along the leg from here; if that leg
  // is vertical, or there is none, the heading stays as it was.
  std::optional<double> heading_rad = {};
  double hold_s = 0;  // how long to wait here after turning
};

std::vector<Waypoint> waypoints_at(const std::vector<Eigen::Vector3d>& positions_m);

// Where the drone is meant to be at a time: the reference of its controller.
struct Reference {
  Eigen::Vector3d position_m;
  Eigen::Vector3d velocity_m_s;
  Eigen::Vector3d acceleration_m_s2;
  double heading_rad = 0;
};

// Straight legs from waypoint to waypoint, from rest to rest: at each the drone brakes to a stop,
// turns on the spot, waits, and flies on. Steep legs are flown slower, to keep within the
// quadrotor's greatest climb and descent.
class Route {
 public:
  // Needs at least two waypoints, and neighbours must differ in position. `wind_m_s`: the mean wind
  // against which the tilt must suffice, see leg_limits. Throws InputError on speeds that
  // leg_limits rejects.
  Route(const Quadrotor& quadrotor, const std::vector<Waypoint>& waypoints, double speed_m_s,
        double wind_m_s = 0);

  double duration_s() const { return duration_s_; }
  // At rest at the first waypoint before 0, at the last one after duration_s().
  Reference at(double time_s) const;

 private:
  // A turn on the spot, a wait, then a straight leg.
  struct Leg {
    Eigen::Vector3d start;
    Eigen::Vector3d direction;  // unit vector
    double heading_before_rad = 0;
    double turn_rad = 0;  // counter-clockwise
    double hold_s = 0;
    RestToRest turn;
    RestToRest flight;
    double begin_s = 0;  // of the route's time

    double duration_s() const { return turn.duration_s() + hold_s + flight.duration_s(); }
  };

  void add_leg(const Quadrotor& quadrotor, const Waypoint& from, const Eigen::Vector3d& way,
               double heading_before_rad, double heading_rad, const MotionLimits& limits);

  std::vector<Leg> legs_;
  double duration_s_ = 0;
};

inline constexpr int kPosesPerSecond = 100;

// The trajectory of the route flown without any error in still air. One pose each 0.01 s from time
// 0.
scan::Trajectory fly_exactly(const Quadrotor& quadrotor, const Route& route);

}  // namespace plotscan::flight
