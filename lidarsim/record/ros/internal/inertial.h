// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "scan/trajectory.h"

namespace plotscan::record {

// What an inertial measurement unit at the body's origin measures, body frame.
struct InertialSample {
  Eigen::Vector3d angular_rate_rad_s;
  Eigen::Vector3d specific_force_m_s2;  // acceleration minus gravity: (0, 0, +9.80665) at rest
};

// The means over an interval of `interval_s` centred on `time_s`, as reported by a unit that
// integrates between its samples. They are exact, since a trajectory is linear and slerp between
// poses: the change of velocity over the interval, in the axes of the attitude at `time_s`, and the
// mean of the piecewise constant rates. Beyond its ends the motion is continued.
InertialSample inertial_sample(const scan::Trajectory& trajectory, double time_s,
                               double interval_s);

}  // namespace plotscan::record
