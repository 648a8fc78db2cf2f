// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/angle.h"
#include "farm/farm.h"

namespace plotscan::farm {

// A plot whose plants lean more than this on average is lodged.
inline constexpr double kLodged_rad = radians(5);

// Least, mean and greatest of some values; all zero without values.
struct Spread {
  double min = 0;
  double mean = 0;
  double max = 0;
};

// The plots of one cultivar in a trial.
struct CultivarSummary {
  int trial = 0;  // as Plot::trial
  std::string name;
  std::size_t plots = 0;
  std::size_t lodged_plots = 0;  // whose plants lean more than kLodged_rad on average
  std::size_t plants = 0;
  std::size_t missing_plants = 0;
  std::size_t weeds = 0;
  double height_mean_m = 0;    // over its plants
  double height_max_m = 0;     // the highest of them
  double plants_per_m2 = 0;    // of the plots' area
  double leaf_area_index = 0;  // as of the farm
};

// A farm at a glance.
struct FarmSummary {
  Eigen::Vector2d terrain_size_m = Eigen::Vector2d::Zero();  // along x and y
  Eigen::Vector2d terrain_z_m = Eigen::Vector2d::Zero();     // lowest and highest vertex
  std::size_t terrain_triangles = 0;
  std::size_t models = 0;
  std::size_t plots = 0;
  std::size_t trials = 0;                                  // that the plots are of
  std::size_t plants = 0;                                  // of the crop
  std::uint64_t plant_triangles = 0;                       // of all placed plants and weeds
  Eigen::Vector2d field_size_m = Eigen::Vector2d::Zero();  // bounding rectangle of the plots
  std::size_t weeds = 0;
  Spread plant_height_m;  // of the crop
  Spread plot_height_max_m;
  // Area of the crop's leaves (mesh::ScaledArea::of_leaves) over the area of the plots.
  double leaf_area_index = 0;
  std::vector<CultivarSummary> cultivars;  // by trial, then by name
};

FarmSummary summarise(const Farm& farm);

}  // namespace plotscan::farm
