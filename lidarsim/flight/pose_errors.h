// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "scan/trajectory.h"

namespace plotscan::flight {

// How far the poses that a drone reports are from where it was, and its sensor from where it is
// said to be mounted. Standard deviations, but for the last three; all zero: not at all.
struct PoseErrors {
  // Of every GNSS fix on its own, and of a part that drifts (a first-order Gauss-Markov process):
  // along east and north each, and up.
  double position_noise_m = 0;
  double height_noise_m = 0;
  double position_drift_m = 0;
  double height_drift_m = 0;
  double position_drift_s = 100;  // after which the drift's correlation has fallen to 1/e
  // The same of roll and pitch each, about the body's axes, and of the heading, about the vertical.
  double tilt_noise_deg = 0;
  double heading_noise_deg = 0;
  double tilt_drift_deg = 0;
  double heading_drift_deg = 0;
  double attitude_drift_s = 100;
  // The sensor is truly turned by Rz(yaw) Ry(pitch) Rx(roll) of this from the stated mount, about
  // the body's axes.
  Eigen::Vector3d boresight_rpy_deg = Eigen::Vector3d::Zero();
  // The sensor truly sits so far from the stated place, body frame.
  Eigen::Vector3d lever_arm_m = Eigen::Vector3d::Zero();
  // The pose reported for a time is that of so much later.
  double clock_offset_s = 0;

  bool poses_are_exact() const;
  bool none() const {
    return poses_are_exact() && boresight_rpy_deg.isZero(0) && lever_arm_m.isZero(0);
  }
};

// The documented sets of errors (docs/pose-errors.md): none, rtk, ppk, gps.
const std::vector<std::string>& pose_error_presets();
PoseErrors pose_error_preset(const std::string& name);

// Both at once: variances and offsets add; the drifts take the times of `own`.
PoseErrors combined(const PoseErrors& preset, const PoseErrors& own);

// The trajectory as the drone reports it: errors of the poses, not of the mount. Has the true
// one's poses and, where there are errors, one at least every 10 ms; fixes come every 100 ms, their
// noise is linear in between. With no errors it is the same.
scan::Trajectory reported_trajectory(const scan::Trajectory& truth, const PoseErrors& errors,
                                     std::uint64_t seed);

// Where the sensor truly sits.
Eigen::Isometry3d true_mount(const Eigen::Isometry3d& stated_body_from_lidar,
                             const PoseErrors& errors);

}  // namespace plotscan::flight
