// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "scan/point.h"
#include "scan/trajectory.h"

namespace plotscan::scan {

// The scan angles of shots as LAS defines them: in the plane across the flight, from straight down,
// positive to the right. The direction of flight is from the position half a second before to that
// half a second after; while hovering, that of the body's nose.
class ScanAngles {
 public:
  // `reported` must outlive this object.
  ScanAngles(const Trajectory& reported, const Eigen::Isometry3d& body_from_lidar)
      : reported_(reported), body_from_lidar_(body_from_lidar) {}

  // In (-pi, pi], of a point in the trajectory's frame and time. Fastest in the order of time.
  double angle_rad(const LabelledPoint& point);

 private:
  Eigen::Vector3d direction(double time_s) const;

  const Trajectory& reported_;
  Eigen::Isometry3d body_from_lidar_;
  double known_s_ = -1e300;  // time of right_
  Eigen::Vector3d right_ = Eigen::Vector3d::UnitX();
};

}  // namespace plotscan::scan
