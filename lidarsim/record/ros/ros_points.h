// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/utc_time.h"
#include "record/ros/transforms.h"
#include "scan/cloud_reader.h"
#include "scan/point.h"
#include "scan/trajectory.h"

namespace plotscan::record {

// The clouds of a ROS 1 bag or an MCAP file, placed in the world by its transforms (/tf,
// /tf_static) at each point's own time, linear and slerp between them. The world is the topmost
// frame above the clouds' own; where nothing is above it, points stay as they are.
class RosPoints {
 public:
  // Reads the whole file and keeps its transforms. `topic` is the topic of the clouds; "" stands
  // for /velodyne_points, or the only topic of PointCloud2. Throws InputError when the file is
  // missing, foreign, truncated or broken, has no clouds, or has several topics of clouds and none
  // is chosen.
  explicit RosPoints(const std::filesystem::path& file, const std::string& topic = "");

  const std::string& topic() const { return topic_; }
  // Time 0 of the points: when the first message was recorded, rounded down to a microsecond.
  UtcTime start() const;
  // The trajectory of the body that carries the sensor, by the transforms, in the world frame and
  // the points' time; absent if no transform moves.
  std::optional<scan::Trajectory> trajectory() const { return path_.motion(); }
  std::uint64_t points() const { return points_; }
  // The names of LabelledPoint's fields that the clouds have.
  const std::vector<std::string>& fields() const { return fields_; }
  // What the user should know: that points have no times of their own.
  std::vector<std::string> notes() const;

  // The origin that points count from: scan::origin_near the body's first position, or the first
  // point of clouds that stand still.
  const Eigen::Vector3d& origin_m() const { return origin_m_; }

  // Streams the points in the file's order, relative to origin_m. Points that are not finite, or
  // from before the first or after the last transform, are left out and counted.
  scan::CloudSummary stream(const scan::PointSink& sink) const;

 private:
  std::filesystem::path file_;
  std::string topic_;
  ros::Time start_;
  std::uint64_t points_ = 0;
  std::vector<std::string> fields_;
  FramePath path_;
  Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();
};

}  // namespace plotscan::record
