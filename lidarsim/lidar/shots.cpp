// SPDX-License-Identifier: Apache-2.0
#include "lidar/shots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace plotscan::lidar {
namespace {

// Turning by an angle below this within one firing sequence is taken to second order: the error,
// its cube over 6, stays below 2e-10.
constexpr double kSmallTurn_rad = 1e-3;

Eigen::Matrix3d rotation(const Eigen::Vector3d& turn_rad) {
  const double angle = turn_rad.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn_rad / angle).toRotationMatrix();
}

// The vector that turns attitude a into b by the shorter way, in a's frame.
Eigen::Vector3d turn_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::AngleAxisd turn(a.conjugate() * b);
  const double angle =
      turn.angle() > std::numbers::pi ? turn.angle() - 2 * std::numbers::pi : turn.angle();
  return angle * turn.axis();
}

}  // namespace

ShotPlan::ShotPlan(const SpinningLidar& sensor, double spin_hz,
                   const Eigen::Isometry3d& body_from_lidar, const scan::Trajectory& trajectory)
    : sequence_s_(sensor.sequence_s), spin_hz_(spin_hz) {
  check(sensor.lasers.size() <= kMaxLasers, "the sensor has too many lasers");
  const Eigen::Matrix3d lidar_from_body = body_from_lidar.linear().transpose();
  for (const Laser& laser : sensor.lasers) {
    const double advance = 2 * std::numbers::pi * spin_hz * laser.fires_s;
    lasers_.push_back({.fires_s = laser.fires_s,
                       .cos_elevation = std::cos(laser.elevation_rad),
                       .sin_elevation = std::sin(laser.elevation_rad),
                       .cos_advance = std::cos(advance),
                       .sin_advance = std::sin(advance),
                       .origin_m = lidar_from_body * body_from_lidar.translation() +
                                   laser.offset_m * Eigen::Vector3d::UnitZ()});
  }
  const auto& poses = trajectory.poses();
  const double start_s = trajectory.start_s();
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const double duration_s = poses[i + 1].time_s - poses[i].time_s;
    segments_.push_back(
        {.start_s = poses[i].time_s - start_s,
         .end_s = poses[i + 1].time_s - start_s,
         .position_m = poses[i].position_m,
         .velocity_m_s = (poses[i + 1].position_m - poses[i].position_m) / duration_s,
         .world_from_lidar = poses[i].attitude.toRotationMatrix() * body_from_lidar.linear(),
         .turn_rad_s = lidar_from_body * turn_between(poses[i].attitude, poses[i + 1].attitude) /
                       duration_s});
  }
  sequences_ = static_cast<std::uint64_t>((trajectory.end_s() - start_s) / sequence_s_);
}

const ShotPlan::Segment& ShotPlan::segment(double time_s) const {
  const auto after =
      std::upper_bound(segments_.begin() + 1, segments_.end(), time_s,
                       [](double time, const Segment& segment) { return time < segment.start_s; });
  return *(after - 1);
}

void ShotPlan::fire(std::uint64_t sequence, SequenceShots& shots) const {
  const double time_s = static_cast<double>(sequence) * sequence_s_;
  const Segment& motion = segment(time_s);
  const bool is_steady = time_s + lasers_.back().fires_s <= motion.end_s &&
                         motion.turn_rad_s.norm() * sequence_s_ <= kSmallTurn_rad;
  if (is_steady) {
    fire_lasers(motion, time_s, 0, lasers_.size(), shots);
    return;
  }
  for (std::size_t k = 0; k < lasers_.size(); ++k)
    fire_lasers(segment(time_s + lasers_[k].fires_s), time_s, k, k + 1, shots);
}

// Lasers begin..end of the sequence that starts at time_s, all within one segment. The attitude is
// exact when the first of them fires and turned on from there to second order.
void ShotPlan::fire_lasers(const Segment& motion, double time_s, std::size_t begin, std::size_t end,
                           SequenceShots& shots) const {
  const double first_s = time_s + lasers_[begin].fires_s;
  const double in_segment_s = first_s - motion.start_s;
  const Eigen::Matrix3d world_from_lidar =
      motion.world_from_lidar * rotation(motion.turn_rad_s * in_segment_s);
  const Eigen::Vector3d position = motion.position_m + motion.velocity_m_s * in_segment_s;
  const double turns = spin_hz_ * time_s;
  const double azimuth = 2 * std::numbers::pi * (turns - std::floor(turns));
  const double cos_start = std::cos(azimuth);
  const double sin_start = std::sin(azimuth);
  for (std::size_t k = begin; k < end; ++k) {
    const LaserConstants& laser = lasers_[k];
    const double cos_azimuth = cos_start * laser.cos_advance - sin_start * laser.sin_advance;
    const double sin_azimuth = sin_start * laser.cos_advance + cos_start * laser.sin_advance;
    const Eigen::Vector3d in_lidar(laser.cos_elevation * cos_azimuth,
                                   -laser.cos_elevation * sin_azimuth, laser.sin_elevation);
    const double later_s = time_s + laser.fires_s - first_s;
    const Eigen::Vector3d turn = motion.turn_rad_s * later_s;
    const auto turned = [&turn](const Eigen::Vector3d& v) -> Eigen::Vector3d {
      const Eigen::Vector3d first_order = turn.cross(v);
      return v + first_order + 0.5 * turn.cross(first_order);
    };
    const Eigen::Vector3d direction = world_from_lidar * turned(in_lidar);
    const Eigen::Vector3d origin =
        position + motion.velocity_m_s * later_s + world_from_lidar * turned(laser.origin_m);
    for (int axis = 0; axis < 3; ++axis) {
      shots.direction[axis][k] = direction[axis];
      shots.origin_m[axis][k] = origin[axis];
    }
  }
}

}  // namespace plotscan::lidar
