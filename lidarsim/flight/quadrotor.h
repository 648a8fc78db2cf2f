// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "flight/rest_to_rest.h"

namespace plotscan::flight {

// A quadrotor as a point mass under thrust, weight and drag. The numbers are those of the Hector
// quadrotor, which flies in the paper's simulation (Meyer et al., SIMPAR 2012; hector_quadrotor:
// mass in quadrotor_base.urdf.xacro, C_wxy in quadrotor_aerodynamics.yaml, attitude, speed and yaw
// limits in limits.yaml); acceleration, jerk and turning are gentler than its limits, as survey
// autopilots fly; climb and descent are PX4's defaults (MPC_Z_VEL_MAX_UP, MPC_Z_VEL_MAX_DN).
struct Quadrotor {
  double mass_kg = 1.477;
  double drag_n_s2_m2 = 0.12;  // force = -drag |v| v, where v is through the air
  double max_tilt_rad = 0.5;
  double max_speed_m_s = 6;
  double max_climb_m_s = 3;
  double max_descent_m_s = 1.5;
  double acceleration_m_s2 = 2;
  double jerk_m_s3 = 4;
  MotionLimits turn = {.speed = 1.5, .acceleration = 3, .jerk = 12};  // heading; rad in place of m
};

// The attitude (world_from_body) that gives the acceleration at the velocity: body z along the
// thrust, m a = thrust - m g z - drag |v| v, and the nose as near the heading as that allows
// (Mellinger and Kumar, ICRA 2011, section III). World frame, m/s^2, m/s, rad from x.
Eigen::Quaterniond attitude_for(const Quadrotor& quadrotor, const Eigen::Vector3d& acceleration,
                                const Eigen::Vector3d& velocity, double heading_rad);

// The same for a given direction of thrust (world frame, any length but 0).
Eigen::Quaterniond attitude_along(const Eigen::Vector3d& thrust, double heading_rad);

// At a lower speed, a flight over even the smallest farm takes hours.
inline constexpr double kMinSpeed_m_s = 0.01;

// Limits of a straight leg flown at speed_m_s: the acceleration is reduced to what the tilt limit
// leaves after drag in a headwind of wind_m_s. Throws InputError when the speed is not in
// [kMinSpeed_m_s, max_speed_m_s]; wind_m_s must be at most holdable_wind_m_s.
MotionLimits leg_limits(const Quadrotor& quadrotor, double speed_m_s, double wind_m_s = 0);

}  // namespace plotscan::flight
