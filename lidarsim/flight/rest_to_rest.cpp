// SPDX-License-Identifier: Apache-2.0
#include "flight/rest_to_rest.h"

#include <algorithm>
#include <cmath>

namespace plotscan::flight {
namespace {

// How long the acceleration grows while speeding up from rest to `speed`.
double jerk_time(double speed, const MotionLimits& limits) {
  return std::min(limits.acceleration / limits.jerk, std::sqrt(speed / limits.jerk));
}

double speed_up_time(double speed, const MotionLimits& limits) {
  const double jerk_s = jerk_time(speed, limits);
  return jerk_s > 0 ? jerk_s + speed / (limits.jerk * jerk_s) : 0;
}

// The top speed at which speeding up and braking together take exactly the whole distance.
double peak_speed(double distance, const MotionLimits& limits) {
  const double jerk_s = std::cbrt(distance / (2 * limits.jerk));
  if (limits.jerk * jerk_s <= limits.acceleration) return limits.jerk * jerk_s * jerk_s;
  const double full_s = limits.acceleration / limits.jerk;
  return limits.acceleration / 2 *
         (std::sqrt(full_s * full_s + 4 * distance / limits.acceleration) - full_s);
}

}  // namespace

RestToRest::RestToRest(double distance, const MotionLimits& limits)
    : distance_(distance), jerk_(limits.jerk) {
  top_speed_ = std::min(limits.speed, peak_speed(distance, limits));
  jerk_time_s_ = jerk_time(top_speed_, limits);
  speed_up_s_ = speed_up_time(top_speed_, limits);
  // Speeding up (or braking) covers half the distance that the same time at top speed would.
  duration_s_ = top_speed_ > 0 ? speed_up_s_ + distance / top_speed_ : 0;
}

double RestToRest::run_up(double speed, const MotionLimits& limits) {
  return speed * speed_up_time(speed, limits) / 2;
}

RestToRest::State RestToRest::at(double time_s) const {
  const double t = std::clamp(time_s, 0.0, duration_s_);
  if (t < speed_up_s_) return speeding_up(t);
  if (t <= duration_s_ - speed_up_s_)
    return {.distance = top_speed_ * (t - speed_up_s_ / 2), .speed = top_speed_, .acceleration = 0};
  const State mirrored = speeding_up(duration_s_ - t);
  return {.distance = distance_ - mirrored.distance,
          .speed = mirrored.speed,
          .acceleration = -mirrored.acceleration};
}

RestToRest::State RestToRest::speeding_up(double t) const {
  const double top_acceleration = jerk_ * jerk_time_s_;
  if (t < jerk_time_s_)
    return {
        .distance = jerk_ * t * t * t / 6, .speed = jerk_ * t * t / 2, .acceleration = jerk_ * t};
  if (t < speed_up_s_ - jerk_time_s_) {
    const double even = t - jerk_time_s_ / 2;  // as if always at the top acceleration
    return {.distance = top_acceleration * (even * even / 2 + jerk_time_s_ * jerk_time_s_ / 24),
            .speed = top_acceleration * even,
            .acceleration = top_acceleration};
  }
  const double left = speed_up_s_ - t;
  return {.distance = top_speed_ * (t - speed_up_s_ / 2) + jerk_ * left * left * left / 6,
          .speed = top_speed_ - jerk_ * left * left / 2,
          .acceleration = jerk_ * left};
}

}  // namespace plotscan::flight
