// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "farm/farm.h"

namespace plotscan::farm {

// Least, mean and greatest of some values; all zero without values.
struct Spread {
  double min = 0;
  double mean = 0;
  double max = 0;
};

// A farm at a glance.
struct FarmSummary {
  Eigen::Vector2d terrain_size_m = Eigen::Vector2d::Zero();  // along x and y
  Eigen::Vector2d terrain_z_m = Eigen::Vector2d::Zero();     // lowest and highest vertex
  std::size_t terrain_triangles = 0;
  std::size_t models = 0;
  std::size_t plots = 0;
  std::size_t plants = 0;
  std::uint64_t plant_triangles = 0;                       // of all placed plants
  Eigen::Vector2d field_size_m = Eigen::Vector2d::Zero();  // bounding rectangle of the plots
  Spread plant_height_m;
  Spread plot_height_max_m;
  // Area of the plants' leaves (mesh::ScaledArea::of_leaves) over the area of the plots.
  double leaf_area_index = 0;
};

FarmSummary summarise(const Farm& farm);

}  // namespace plotscan::farm
