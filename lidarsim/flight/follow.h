// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <Eigen/Core>

#include "flight/quadrotor.h"
#include "flight/route.h"
#include "flight/wind.h"
#include "scan/trajectory.h"

namespace plotscan::flight {

// How the autopilot follows its route: the cascade of PX4's multicopter position control, with its
// default gains and limits (MPC_XY_P, MPC_XY_VEL_P_ACC, ..._I_ACC, ..._D_ACC, the same of Z;
// MC_ROLL_P; MPC_THR_MIN and MPC_THR_MAX over MPC_THR_HOVER). x and y have one gain, z another.
struct Autopilot {
  Eigen::Vector3d position_1_s = {0.95, 0.95, 1};  // velocity asked for per metre of error
  Eigen::Vector3d velocity_1_s = {1.8, 1.8, 4};    // acceleration per m/s of error
  Eigen::Vector3d integral_1_s2 = {0.4, 0.4, 2};   // its growth per m/s of error
  Eigen::Vector3d derivative = {0.2, 0.2, 0};      // acceleration per m/s^2 of error
  double thrust_lag_s = 1 / 6.5;                   // time constant with which thrust turns
  double least_thrust_g = 0.24;                    // as a share of the weight, like the next
  double greatest_thrust_g = 2;
};

// The velocity of the air that the drone flies in, and of the mean wind that its autopilot assumes.
// World frame, m/s.
struct Air {
  std::function<Eigen::Vector3d(double time_s)> velocity_m_s;
  Eigen::Vector3d expected_m_s = Eigen::Vector3d::Zero();
};

// Flies the route through the air: m a = thrust - m g z - drag |v - w| (v - w), thrust following
// the autopilot with a first-order lag within the limits of tilt and thrust, integrated by RK4 in
// steps of 5 ms. Before the flight begins, the drone hovers at the start for Wind::kLeadIn_s. One
// pose each 0.01 s from time 0. The nose points along the route's heading, body z along the thrust.
scan::Trajectory follow(const Quadrotor& quadrotor, const Route& route, const Air& air,
                        const Autopilot& autopilot = {});

// The strongest mean wind, m/s, in which the drone can fly a route at this speed: at its greatest
// tilt it still has 0.5 m/s^2 to spare against a headwind with a gust of two standard deviations. 0
// if even still air leaves it less.
double holdable_wind_m_s(const Quadrotor& quadrotor, double speed_m_s, double turbulence);

}  // namespace plotscan::flight
