// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "scan/trajectory.h"

namespace plotscan::record {

// What an inertial measurement unit at the body's origin feels, body frame.
struct InertialSample {
  Eigen::Vector3d angular_rate_rad_s;
  Eigen::Vector3d specific_force_m_s2;  // acceleration less gravity: (0, 0, +9.80665) at rest
};

// The means over `interval_s` around the time, as a unit reports them that integrates between its
// samples. A trajectory is linear and slerp between poses, so they are exact: the velocity's change
// over the interval, in the axes of the attitude at the time, and the mean of the constant rates.
// Beyond its ends the trajectory goes on as it began and ended.
InertialSample inertial_sample(const scan::Trajectory& trajectory, double time_s,
                               double interval_s);

}  // namespace plotscan::record
