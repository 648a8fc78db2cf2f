// SPDX-License-Identifier: Apache-2.0
#include "scan/trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.h"
#include "core/csv.h"
#include "core/error.h"

namespace plotscan::scan {
namespace {

// Larger than any northing of a projected coordinate system.
constexpr double kFarthest_m = 2e7;
// Files state quaternions with four or more decimals. If the norm is further than this from 1, they
// are no attitudes.
constexpr double kNormTolerance = 0.01;

}  // namespace

Eigen::AngleAxisd shorter_turn(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  Eigen::AngleAxisd turn(a.conjugate() * b);
  if (turn.angle() > kPi) turn.angle() -= 2 * kPi;
  return turn;
}

void require_flight_time(const std::filesystem::path& file, const Trajectory& trajectory) {
  const double taken_s = trajectory.end_s() - trajectory.start_s();
  if (taken_s <= kLongestFlight_s) return;
  throw InputError(
      file, "the flight takes {} s; at most {} s are allowed (the file's times are in seconds)",
      format_number(taken_s), format_number(kLongestFlight_s));
}

std::string pose_error(const StampedPose& pose, double previous_s) {
  if (!std::isfinite(pose.time_s) || !pose.position_m.allFinite() ||
      !pose.attitude.coeffs().allFinite())
    return "a number is not finite";
  if (pose.position_m.cwiseAbs().maxCoeff() > kFarthest_m) {
    return "the position is more than " + format_number(kFarthest_m) +
           " m from the origin; metres are expected";
  }
  if (pose.time_s <= previous_s) {
    return "time " + format_number(pose.time_s) + " s is not after the previous pose's " +
           format_number(previous_s) + " s";
  }
  if (std::abs(pose.attitude.norm() - 1) > kNormTolerance) {
    return "quaternion norm " + format_number(pose.attitude.norm()) +
           " is not 1 (order: t x y z qx qy qz qw)";
  }
  return "";
}

Trajectory::Trajectory(std::vector<StampedPose> poses) : poses_(std::move(poses)) {
  if (poses_.size() < 2) throw InputError("a trajectory needs at least two poses");
  double previous_s = -std::numeric_limits<double>::infinity();
  for (StampedPose& pose : poses_) {
    const std::string error = pose_error(pose, previous_s);
    if (!error.empty()) throw InputError("trajectory: " + error);
    pose.attitude.normalize();
    previous_s = pose.time_s;
  }
}

std::size_t Trajectory::segment(double time_s) const {
  const auto after =
      std::upper_bound(poses_.begin() + 1, poses_.end() - 1, time_s,
                       [](double time, const StampedPose& pose) { return time < pose.time_s; });
  return static_cast<std::size_t>(after - poses_.begin()) - 1;
}

Eigen::Isometry3d Trajectory::world_from_body(double time_s) const {
  const std::size_t i = segment(time_s);
  const StampedPose& a = poses_[i];
  const StampedPose& b = poses_[i + 1];
  const double share = std::clamp((time_s - a.time_s) / (b.time_s - a.time_s), 0.0, 1.0);
  Eigen::Isometry3d pose(a.attitude.slerp(share, b.attitude));
  pose.pretranslate(a.position_m + share * (b.position_m - a.position_m));
  return pose;
}

Trajectory moved(const Trajectory& trajectory, const Eigen::Vector3d& by_m) {
  std::vector<StampedPose> poses = trajectory.poses();
  for (StampedPose& pose : poses) pose.position_m += by_m;
  return Trajectory(std::move(poses));
}

Trajectory delayed(const Trajectory& trajectory, double by_s) {
  std::vector<StampedPose> poses = trajectory.poses();
  for (StampedPose& pose : poses) pose.time_s += by_s;
  return Trajectory(std::move(poses));
}

}  // namespace plotscan::scan
