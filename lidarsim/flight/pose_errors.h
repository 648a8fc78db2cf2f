// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "scan/trajectory.h"

namespace plotscan::flight {

// Errors of the poses that a drone reports, and of where its sensor is said to be mounted. Standard
// deviations, except for the time constants and the last three. All zero: no errors.
struct PoseErrors {
  // Position errors: noise that is independent for every GNSS fix, and a drift (a first-order
  // Gauss-Markov process). `position` is along east and along north each, `height` is up.
  double position_noise_m = 0;
  double height_noise_m = 0;
  double position_drift_m = 0;
  double height_drift_m = 0;
  double position_drift_s = 100;  // after which the drift's correlation has fallen to 1/e
  // The same for the attitude: `tilt` is roll and pitch each, about the body's axes, `heading` is
  // about the vertical.
  double tilt_noise_deg = 0;
  double heading_noise_deg = 0;
  double tilt_drift_deg = 0;
  double heading_drift_deg = 0;
  double attitude_drift_s = 100;
  // The sensor is truly turned by Rz(yaw) Ry(pitch) Rx(roll) of this from the stated mount, about
  // the body's axes.
  Eigen::Vector3d boresight_rpy_deg = Eigen::Vector3d::Zero();
  // The sensor's true position minus the stated one, body frame.
  Eigen::Vector3d lever_arm_m = Eigen::Vector3d::Zero();
  // The pose reported for time t is the one at t + clock_offset_s.
  double clock_offset_s = 0;

  bool poses_are_exact() const;
  bool none() const {
    return poses_are_exact() && boresight_rpy_deg.isZero(0) && lever_arm_m.isZero(0);
  }
};

// The documented sets of errors (docs/pose-errors.md): none, rtk, ppk, gps.
const std::vector<std::string>& pose_error_presets();
PoseErrors pose_error_preset(const std::string& name);

// Both sets of errors at once: variances and offsets add; time constants are those of `own`.
PoseErrors combined(const PoseErrors& preset, const PoseErrors& own);

// The trajectory as the drone reports it, with errors of the poses but not of the mount. It has
// poses at the times of the true one and, if there are errors, at least every 10 ms. Fixes come
// every 100 ms; between them the errors are linear. Without errors it equals the true one.
scan::Trajectory reported_trajectory(const scan::Trajectory& truth, const PoseErrors& errors,
                                     std::uint64_t seed);

// The sensor's true mount, body_from_lidar.
Eigen::Isometry3d true_mount(const Eigen::Isometry3d& stated_body_from_lidar,
                             const PoseErrors& errors);

}  // namespace plotscan::flight
