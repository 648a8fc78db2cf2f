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

// The way from a frame to the topmost above it.
class FramePath {
 public:
  const std::string& top() const { return top_; }
  // Time in seconds as in RosTransforms. Nothing before the first or after the last transform.
  std::optional<Eigen::Isometry3d> top_from_frame(double time_s) const;
  // How the first frame on the way that moves in the one above it, a drone's body above its sensor,
  // moves in the topmost: at the times of its own transforms that those above it cover. Nothing
  // where all stand still.
  std::optional<scan::Trajectory> motion() const;

 private:
  friend class RosTransforms;
  using Still = Eigen::Isometry3d;
  // The same from the frame below the step `first` on.
  std::optional<Eigen::Isometry3d> top_from_step(std::size_t first, double time_s) const;

  std::string top_;
  std::vector<std::variant<Still, scan::Trajectory>> steps_;  // parent_from_child, upwards
};

// The transforms between a recording's frames, over time.
class RosTransforms {
 public:
  // Transforms of one message; `still`: they hold for all times (/tf_static). Times count from
  // `epoch`. Throws InputError on a transform that is none.
  void add(const ros::TFMessage& message, ros::Time epoch, bool still);

  // Throws InputError where the frames lead in a circle, or a frame is further from the one above
  // it than a trajectory may lead.
  FramePath path(const std::string& frame) const;

 private:
  struct Edge {
    std::string parent;
    bool still = false;
    std::vector<scan::StampedPose> poses;  // parent_from_child
  };
  std::map<std::string, Edge> edges_;  // by child
};

}  // namespace plotscan::record
