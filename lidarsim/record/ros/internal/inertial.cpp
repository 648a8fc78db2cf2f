// SPDX-License-Identifier: Apache-2.0
#include "record/ros/internal/inertial.h"

#include "core/gravity.h"

namespace plotscan::record {
namespace {

using Eigen::Vector3d;

double duration_s(const scan::Trajectory& trajectory, std::size_t segment) {
  return trajectory.poses()[segment + 1].time_s - trajectory.poses()[segment].time_s;
}

Vector3d velocity(const scan::Trajectory& trajectory, std::size_t segment) {
  const auto& poses = trajectory.poses();
  return (poses[segment + 1].position_m - poses[segment].position_m) /
         duration_s(trajectory, segment);
}

// Slerp turns at a constant rate about an axis that is fixed in the body.
Vector3d angular_rate(const scan::Trajectory& trajectory, std::size_t segment) {
  const auto& poses = trajectory.poses();
  const Eigen::AngleAxisd turn =
      scan::shorter_turn(poses[segment].attitude, poses[segment + 1].attitude);
  return turn.angle() / duration_s(trajectory, segment) * turn.axis();
}

}  // namespace

InertialSample inertial_sample(const scan::Trajectory& trajectory, double time_s,
                               double interval_s) {
  const double begin_s = time_s - interval_s / 2;
  const double end_s = time_s + interval_s / 2;
  const std::size_t first = trajectory.segment(begin_s);
  const std::size_t last = trajectory.segment(end_s);
  Vector3d turned = Vector3d::Zero();
  for (std::size_t i = first; i <= last; ++i) {
    const double from_s = i == first ? begin_s : trajectory.poses()[i].time_s;
    const double to_s = i == last ? end_s : trajectory.poses()[i + 1].time_s;
    turned += (to_s - from_s) * angular_rate(trajectory, i);
  }
  const Vector3d acceleration =
      (velocity(trajectory, last) - velocity(trajectory, first)) / interval_s;
  const Eigen::Matrix3d body_from_world = trajectory.world_from_body(time_s).linear().transpose();
  return {
      .angular_rate_rad_s = turned / interval_s,
      .specific_force_m_s2 = body_from_world * (acceleration + kGravity_m_s2 * Vector3d::UnitZ())};
}

}  // namespace plotscan::record
