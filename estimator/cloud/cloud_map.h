// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "cloud/area.h"
#include "core/cloud_files.h"
#include "core/progress.h"

namespace plotscan::cloud {

// The merged map inside an area, at the scans' full density. Positions are kept as float32 relative
// to an origin in double precision (12 bytes a point, better than 0.5 mm in the largest area).
class CloudMap {
 public:
  // An empty map. The origin is the area's centre rounded to whole metres, so that a cloud moved by
  // whole metres gives the same relative positions.
  explicit CloudMap(const Area& area);

  // Keeps the points (world frame, metres) that lie in the area.
  void add(std::span<const Eigen::Vector3d> world_points);

  const Area& area() const { return area_; }
  const Eigen::Vector3d& origin() const { return origin_; }
  // Relative to origin().
  const std::vector<Eigen::Vector3f>& points() const { return points_; }
  // How many points add() was given.
  std::size_t points_read() const { return points_read_; }
  // Points of the cloud that add() was not given.
  struct NotGiven {
    std::size_t not_finite = 0;
    std::size_t left_out = 0;  // of a class that CloudFiles excludes
  };
  void note(const NotGiven& not_given) { not_given_ = not_given; }
  const NotGiven& not_given() const { return not_given_; }

 private:
  Area area_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> points_;
  std::size_t points_read_ = 0;
  NotGiven not_given_;
};

// The part of a cloud to read, and its name in messages.
struct NamedArea {
  Area area{};
  std::string name = "crop box";
};

// Streams a cloud into a map of the area. Without an area, a first pass over the files finds the
// densely scanned field (find_field), whose bounds are the area. Memory is bounded by the points
// inside the area. Throws InputError on a broken cloud or when no point lies in the area.
CloudMap read_map(const CloudFiles& cloud, const std::optional<NamedArea>& area,
                  const ProgressReport& progress = {});

}  // namespace plotscan::cloud
