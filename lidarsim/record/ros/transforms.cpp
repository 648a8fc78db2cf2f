// SPDX-License-Identifier: Apache-2.0
#include "record/ros/transforms.h"

#include <algorithm>
#include <limits>

#include "core/error.h"

namespace plotscan::record {
namespace {

// tf2 dropped the leading slash of frame names; old recordings still have it.
std::string frame_name(const std::string& name) {
  return name.starts_with('/') ? name.substr(1) : name;
}

// Tolerance: times of clouds and of transforms are rounded separately.
constexpr double kRounding_s = 1e-6;

scan::StampedPose pose_of(const ros::TransformStamped& transform, ros::Time epoch) {
  const ros::Vector3& t = transform.transform.translation;
  const ros::Quaternion& q = transform.transform.rotation;
  scan::StampedPose pose{.time_s = 1e-9 * static_cast<double>(transform.header.stamp.ns - epoch.ns),
                         .position_m = {t.x, t.y, t.z},
                         .attitude = {q.w, q.x, q.y, q.z}};
  const std::string error = pose_error(pose, -std::numeric_limits<double>::infinity());
  if (!error.empty())
    throw InputError("the transform of frame \"" + transform.child_frame_id + "\": " + error);
  return pose;
}

Eigen::Isometry3d still_pose(const scan::StampedPose& pose) {
  Eigen::Isometry3d isometry(pose.attitude.normalized());
  isometry.pretranslate(pose.position_m);
  return isometry;
}

// The poses sorted by time, each time only once.
std::vector<scan::StampedPose> ordered(std::vector<scan::StampedPose> poses) {
  std::ranges::stable_sort(poses, {}, &scan::StampedPose::time_s);
  const auto same_time = [](const scan::StampedPose& one, const scan::StampedPose& other) {
    return one.time_s == other.time_s;
  };
  poses.erase(std::unique(poses.begin(), poses.end(), same_time), poses.end());
  return poses;
}

}  // namespace

std::optional<Eigen::Isometry3d> FramePath::top_from_frame(double time_s) const {
  return top_from_step(0, time_s);
}

std::optional<Eigen::Isometry3d> FramePath::top_from_step(std::size_t first, double time_s) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t i = first; i < steps_.size(); ++i) {
    if (const auto* still = std::get_if<Still>(&steps_[i])) {
      pose = *still * pose;
      continue;
    }
    const auto& moves = std::get<scan::Trajectory>(steps_[i]);
    if (time_s < moves.start_s() - kRounding_s || time_s > moves.end_s() + kRounding_s)
      return std::nullopt;
    pose = moves.world_from_body(time_s) * pose;
  }
  return pose;
}

std::optional<scan::Trajectory> FramePath::motion() const {
  const auto step = std::ranges::find_if(
      steps_, [](const auto& any) { return std::holds_alternative<scan::Trajectory>(any); });
  if (step == steps_.end()) return std::nullopt;
  const auto first = static_cast<std::size_t>(step - steps_.begin());
  std::vector<scan::StampedPose> poses;
  for (const scan::StampedPose& own : std::get<scan::Trajectory>(*step).poses()) {
    const auto pose = top_from_step(first, own.time_s);
    if (!pose) continue;
    poses.push_back({.time_s = own.time_s,
                     .position_m = pose->translation(),
                     .attitude = Eigen::Quaterniond(pose->linear())});
  }
  if (poses.size() < 2) return std::nullopt;
  return scan::Trajectory(std::move(poses));
}

void RosTransforms::add(const ros::TFMessage& message, ros::Time epoch, bool still) {
  for (const ros::TransformStamped& transform : message.transforms) {
    Edge& edge = edges_[frame_name(transform.child_frame_id)];
    edge.parent = frame_name(transform.header.frame_id);
    edge.still = still;
    const scan::StampedPose pose = pose_of(transform, epoch);
    if (still) edge.poses.clear();
    edge.poses.push_back(pose);
  }
}

FramePath RosTransforms::path(const std::string& frame) const {
  FramePath path;
  std::string top = frame_name(frame);
  for (auto found = edges_.find(top); found != edges_.end(); found = edges_.find(top)) {
    if (path.steps_.size() == edges_.size())
      throw InputError("the frames above \"" + frame + "\" lead in a circle");
    const Edge& edge = found->second;
    const std::vector<scan::StampedPose> poses = ordered(edge.poses);
    if (edge.still || poses.size() == 1)
      path.steps_.emplace_back(still_pose(poses.back()));
    else
      path.steps_.emplace_back(scan::Trajectory(poses));
    top = edge.parent;
  }
  return path;
}

}  // namespace plotscan::record
