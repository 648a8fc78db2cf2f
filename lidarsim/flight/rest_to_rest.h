// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan::flight {

struct MotionLimits {
  double speed = 0;         // m/s, or rad/s for a turn
  double acceleration = 0;  // m/s^2
  double jerk = 0;          // m/s^3
};

// The fastest motion over a distance from rest to rest within the limits of speed, acceleration and
// jerk: the seven phases of constant jerk of Biagiotti and Melchiorri, Trajectory Planning for
// Automatic Machines and Robots (2008), section 3.4.
class RestToRest {
 public:
  struct State {
    double distance = 0;
    double speed = 0;
    double acceleration = 0;
  };

  // Needs distance >= 0 and limits > 0.
  RestToRest(double distance, const MotionLimits& limits);

  double duration_s() const { return duration_s_; }
  // At rest before 0 and after duration_s().
  State at(double time_s) const;

  // The distance in which rest becomes `speed`, m.
  static double run_up(double speed, const MotionLimits& limits);

 private:
  State speeding_up(double time_s) const;

  double distance_ = 0;
  double jerk_ = 0;
  double jerk_time_s_ = 0;  // of each phase in which the acceleration changes
  double speed_up_s_ = 0;   // from rest to the top speed
  double top_speed_ = 0;
  double duration_s_ = 0;
};

}  // namespace plotscan::flight
