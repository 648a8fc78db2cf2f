// SPDX-License-Identifier: Apache-2.0
#include "scan/scan_angles.h"

#include <cmath>

namespace plotscan::scan {
namespace {

constexpr double kHalfWindow_s = 0.5;
// A shorter way than this within the window counts as hovering.
constexpr double kLeastWay_m = 0.25;
// How long a direction is reused.
constexpr double kKept_s = 0.01;

Eigen::Vector3d horizontal(Eigen::Vector3d vector) {
  vector.z() = 0;
  return vector;
}

}  // namespace

double ScanAngles::angle_rad(const LabelledPoint& point) {
  const double time_s = point.time;
  if (!(std::abs(time_s - known_s_) < kKept_s)) {
    right_ = direction(time_s).cross(Eigen::Vector3d::UnitZ()).normalized();
    known_s_ = time_s;
  }
  const Eigen::Vector3d sensor_m =
      reported_.world_from_body(time_s) * body_from_lidar_.translation();
  const Eigen::Vector3d ray = Eigen::Vector3d(point.x, point.y, point.z) - sensor_m;
  return std::atan2(ray.dot(right_), -ray.z());
}

Eigen::Vector3d ScanAngles::direction(double time_s) const {
  Eigen::Vector3d way = horizontal(reported_.world_from_body(time_s + kHalfWindow_s).translation() -
                                   reported_.world_from_body(time_s - kHalfWindow_s).translation());
  if (way.norm() > kLeastWay_m) return way;
  const Eigen::Vector3d nose = horizontal(reported_.world_from_body(time_s).linear().col(0));
  return nose.norm() > 0 ? nose : Eigen::Vector3d::UnitX();
}

}  // namespace plotscan::scan
