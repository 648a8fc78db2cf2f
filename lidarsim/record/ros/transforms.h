// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "record/ros/messages.h"
#include "scan/trajectory.h"

namespace plotscan::record {

// The chain of transforms from a frame up to the topmost frame above it.
class FramePath {
 public:
  // The pose at a time in seconds, counted as in RosTransforms. Nothing before the first or after
  // the last transform.
  std::optional<Eigen::Isometry3d> top_from_frame(double time_s) const;
  // The motion, in the topmost frame, of the first frame on the way up that moves relative to its
  // parent: the drone's body, above its sensor. Its poses are at the times of its own transforms,
  // as far as the transforms above cover them. Absent if all frames stand still.
  std::optional<scan::Trajectory> motion() const;

 private:
  friend class RosTransforms;
  using Still = Eigen::Isometry3d;
  // The same, but from the frame below step `first` upwards.
  std::optional<Eigen::Isometry3d> top_from_step(std::size_t first, double time_s) const;

  std::vector<std::variant<Still, scan::Trajectory>> steps_;  // parent_from_child, upwards
};

// The transforms between a recording's frames, over time.
class RosTransforms {
 public:
  // Adds the transforms of one message. `still`: they hold for all times (/tf_static). Times count
  // from `epoch`. Throws InputError on an invalid transform.
  void add(const ros::TFMessage& message, ros::Time epoch, bool still);

  // The path from a frame to the top. Throws InputError when the frames form a circle, or a frame
  // is further from its parent than a trajectory may reach.
  FramePath path(const std::string& frame) const;

 private:
  struct Edge {
    std::string parent;
    bool still = false;
    std::vector<scan::StampedPose> poses;  // parent_from_child
  };
  std::map<std::string, Edge> edges_;  // by name of the child frame
};

}  // namespace plotscan::record
