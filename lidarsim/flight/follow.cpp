// SPDX-License-Identifier: Apache-2.0
#include "flight/follow.h"

#include <algorithm>
#include <cmath>

#include "core/gravity.h"

namespace plotscan::flight {
namespace {

constexpr int kStepsPerPose = 2;
constexpr double kStep_s = 1.0 / (kPosesPerSecond * kStepsPerPose);
constexpr double kReserve_m_s2 = 0.5;
constexpr double kGustDeviations = 2;

// The columns of State. Thrust and integral are accelerations: thrust divided by mass, m/s^2.
enum Column { kPosition, kVelocity, kThrust, kIntegral };
using State = Eigen::Matrix<double, 3, 4>;

struct Thrust {
  Eigen::Vector3d m_s2;
  bool level_limited = false;
  bool height_limited = false;
};

class Loop {
 public:
  Loop(const Quadrotor& quadrotor, const Route& route, const Air& air, const Autopilot& autopilot)
      : quadrotor_(quadrotor), route_(route), air_(air), autopilot_(autopilot) {}

  // The state of hovering in the expected wind where the route starts.
  State start() const {
    State state = State::Zero();
    state.col(kPosition) = route_.at(0).position_m;
    state.col(kThrust) =
        limited(drag(-air_.expected_m_s) + kGravity_m_s2 * Eigen::Vector3d::UnitZ()).m_s2;
    return state;
  }

  // The classical Runge-Kutta method of fourth order.
  State step(double time_s, const State& state) const {
    const State a = slope(time_s, state);
    const State b = slope(time_s + kStep_s / 2, state + kStep_s / 2 * a);
    const State c = slope(time_s + kStep_s / 2, state + kStep_s / 2 * b);
    const State d = slope(time_s + kStep_s, state + kStep_s * c);
    return state + kStep_s / 6 * (a + 2 * b + 2 * c + d);
  }

  scan::StampedPose pose(double time_s, const State& state) const {
    return {.time_s = time_s,
            .position_m = state.col(kPosition),
            .attitude = attitude_along(state.col(kThrust), route_.at(time_s).heading_rad)};
  }

 private:
  // The thrust over mass that cancels drag at this velocity through the air.
  Eigen::Vector3d drag(const Eigen::Vector3d& through_air_m_s) const {
    return quadrotor_.drag_n_s2_m2 / quadrotor_.mass_kg * through_air_m_s.norm() * through_air_m_s;
  }

  // Limits thrust and tilt. Height has priority, as in PX4: horizontal thrust gets what is left.
  Thrust limited(const Eigen::Vector3d& wanted_m_s2) const {
    Thrust thrust{.m_s2 = wanted_m_s2};
    const double greatest = autopilot_.greatest_thrust_g * kGravity_m_s2;
    double& up = thrust.m_s2.z();
    up = std::clamp(up, autopilot_.least_thrust_g * kGravity_m_s2, greatest);
    thrust.height_limited = up != wanted_m_s2.z();
    const double level = wanted_m_s2.head<2>().norm();
    const double most = std::min(up * std::tan(quadrotor_.max_tilt_rad),
                                 std::sqrt(std::max(0.0, greatest * greatest - up * up)));
    thrust.level_limited = level > most;
    if (thrust.level_limited) thrust.m_s2.head<2>() *= most / level;
    return thrust;
  }

  State slope(double time_s, const State& state) const {
    const Reference reference = route_.at(time_s);
    const Eigen::Vector3d velocity = state.col(kVelocity);
    const Eigen::Vector3d gravity = kGravity_m_s2 * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d acceleration =
        state.col(kThrust) - gravity - drag(velocity - air_.velocity_m_s(time_s));
    const Eigen::Vector3d speed_error =
        autopilot_.position_1_s.cwiseProduct(reference.position_m - state.col(kPosition)) +
        reference.velocity_m_s - velocity;
    const Thrust asked = limited(
        reference.acceleration_m_s2 + gravity + drag(reference.velocity_m_s - air_.expected_m_s) +
        autopilot_.velocity_1_s.cwiseProduct(speed_error) + state.col(kIntegral) +
        autopilot_.derivative.cwiseProduct(reference.acceleration_m_s2 - acceleration));
    State slope;
    slope.col(kPosition) = velocity;
    slope.col(kVelocity) = acceleration;
    slope.col(kThrust) = (asked.m_s2 - state.col(kThrust)) / autopilot_.thrust_lag_s;
    slope.col(kIntegral) = autopilot_.integral_1_s2.cwiseProduct(speed_error);
    // Anti-windup: at a limit the integral does not grow.
    if (asked.level_limited) slope.col(kIntegral).head<2>().setZero();
    if (asked.height_limited) slope(2, kIntegral) = 0;
    return slope;
  }

  const Quadrotor& quadrotor_;
  const Route& route_;
  const Air& air_;
  const Autopilot& autopilot_;
};

}  // namespace

scan::Trajectory follow(const Quadrotor& quadrotor, const Route& route, const Air& air,
                        const Autopilot& autopilot) {
  const Loop loop(quadrotor, route, air, autopilot);
  State state = loop.start();
  const auto last = static_cast<std::int64_t>(std::ceil(route.duration_s() * kPosesPerSecond));
  std::vector<scan::StampedPose> poses;
  poses.reserve(static_cast<std::size_t>(last) + 1);
  constexpr auto kFirst = static_cast<std::int64_t>(-Wind::kLeadIn_s * kPosesPerSecond);
  for (std::int64_t pose = kFirst; pose <= last; ++pose) {
    const double time_s = static_cast<double>(pose) / kPosesPerSecond;
    if (pose >= 0) poses.push_back(loop.pose(time_s, state));
    for (int step = 0; step < kStepsPerPose; ++step)
      state = loop.step(time_s + step * kStep_s, state);
  }
  return scan::Trajectory(std::move(poses));
}

double holdable_wind_m_s(const Quadrotor& quadrotor, double speed_m_s, double turbulence) {
  const double against_drag =
      kGravity_m_s2 * std::tan(quadrotor.max_tilt_rad) - kReserve_m_s2;  // m/s^2
  const double airspeed =
      std::sqrt(std::max(0.0, against_drag) * quadrotor.mass_kg / quadrotor.drag_n_s2_m2);
  return std::max(0.0, (airspeed - speed_m_s) / (1 + kGustDeviations * turbulence));
}

}  // namespace plotscan::flight
