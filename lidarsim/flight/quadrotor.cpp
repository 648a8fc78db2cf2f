// SPDX-License-Identifier: Apache-2.0
#include "flight/quadrotor.h"

#include <algorithm>
#include <cmath>

#include "core/csv.h"
#include "core/error.h"
#include "core/gravity.h"

namespace plotscan::flight {

Eigen::Quaterniond attitude_for(const Quadrotor& quadrotor, const Eigen::Vector3d& acceleration,
                                const Eigen::Vector3d& velocity, double heading_rad) {
  const Eigen::Vector3d drag = -quadrotor.drag_n_s2_m2 * velocity.norm() * velocity;
  const Eigen::Vector3d thrust_per_mass =
      acceleration + kGravity_m_s2 * Eigen::Vector3d::UnitZ() - drag / quadrotor.mass_kg;
  return attitude_along(thrust_per_mass, heading_rad);
}

Eigen::Quaterniond attitude_along(const Eigen::Vector3d& thrust, double heading_rad) {
  const Eigen::Vector3d nose(std::cos(heading_rad), std::sin(heading_rad), 0);
  Eigen::Matrix3d world_from_body;
  world_from_body.col(2) = thrust.normalized();
  world_from_body.col(1) = world_from_body.col(2).cross(nose).normalized();
  world_from_body.col(0) = world_from_body.col(1).cross(world_from_body.col(2));
  return Eigen::Quaterniond(world_from_body);
}

MotionLimits leg_limits(const Quadrotor& quadrotor, double speed_m_s, double wind_m_s) {
  if (!(speed_m_s >= kMinSpeed_m_s && speed_m_s <= quadrotor.max_speed_m_s)) {
    throw InputError("speed " + format_number(speed_m_s) + " m/s must be in [" +
                     format_number(kMinSpeed_m_s) + ", " + format_number(quadrotor.max_speed_m_s) +
                     "] m/s");
  }
  const double airspeed = speed_m_s + wind_m_s;
  const double against_drag = quadrotor.drag_n_s2_m2 * airspeed * airspeed / quadrotor.mass_kg;
  const double by_tilt = kGravity_m_s2 * std::tan(quadrotor.max_tilt_rad) - against_drag;
  check(by_tilt > 0, "the quadrotor's tilt holds its top speed");
  return {.speed = speed_m_s,
          .acceleration = std::min(quadrotor.acceleration_m_s2, by_tilt),
          .jerk = quadrotor.jerk_m_s3};
}

}  // namespace plotscan::flight
