// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>

#include "cloud/cloud_map.h"
#include <Eigen/Core>

namespace plotscan::cloud {

// Finds the scanned field in a cloud of which a lidar also saw the far surroundings: points are
// counted in square cells of 1 m; a cell is dense when it holds at least kDenseShare of the count
// of the cell in which the median point lies; the field is the bounding rectangle of the largest
// edge-connected patch of dense cells. Memory is bounded by the scanned area.
class FieldFinder {
 public:
  static constexpr double kCell_m = 1.0;
  static constexpr double kDenseShare = 0.25;

  void add(std::span<const Eigen::Vector3d> world_points);
  // Throws InputError when no point was added.
  Area field() const;

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> count_by_cell_;
};

}  // namespace plotscan::cloud
