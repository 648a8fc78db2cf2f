// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "scan/point.h"
#include "scan/trajectory.h"

namespace plotscan::scan {

// The angles of a scan's shots as LAS tells them: in the plane across the flight, from straight
// down, counter-clockwise seen from behind: positive to the right. The flight's direction is that
// of half a second before to half a second after; the body's nose while it hovers.
class ScanAngles {
 public:
  // Both have to live as long as this.
  ScanAngles(const Trajectory& reported, const Eigen::Isometry3d& body_from_lidar)
      : reported_(reported), body_from_lidar_(body_from_lidar) {}

  // In (-pi, pi]. Points in the trajectory's frame and time; fastest in the order of time.
  double angle_rad(const LabelledPoint& point);

 private:
  Eigen::Vector3d direction(double time_s) const;

  const Trajectory& reported_;
  Eigen::Isometry3d body_from_lidar_;
  double known_s_ = -1e300;  // time of right_
  Eigen::Vector3d right_ = Eigen::Vector3d::UnitX();
};

}  // namespace plotscan::scan
