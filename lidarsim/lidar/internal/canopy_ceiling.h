// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "terrain/border.h"

#include "farm/farm.h"
#include "lidar/internal/ceiling_map.h"
#include "lidar/internal/ray_grid.h"

namespace plotscan::lidar {

// What the canopy under a ray straight down cannot exceed, without casting the ray: so that of many
// rays only those are cast that may be among the highest. Needs the farm, unchanged.
class CanopyCeiling {
 public:
  // Every plant's model has to be there.
  explicit CanopyCeiling(const farm::Farm& farm);

  // For each of the grid's rays a height above the ground, metres: what the ray meets is no higher,
  // and where it is 0 the ray meets the ground. Nothing where some ray may miss the terrain, or
  // where plants stand so close that casting all rays takes no longer.
  std::optional<std::vector<float>> over(const RayGrid& grid) const;

 private:
  // A plant as a ray from above meets it.
  struct Standing {
    const CeilingMap* map;
    Eigen::Matrix2d map_from_world;  // turns and scales
    Eigen::Vector2d foot_m;
    double foot_z_m;
    double z_scale;
    double reach_m;
  };
  struct Maps {
    CeilingMap upright;
    CeilingMap of_any_turn;
  };

  Standing standing(const farm::Plant& plant) const;
  void sort_plants();
  std::size_t square_of(const Eigen::Vector2d& place) const;
  std::array<Eigen::Index, 2> column_and_row(const Eigen::Vector2d& place) const;
  std::vector<Standing> plants_near(const RayGrid& grid) const;
  void raise(const Standing& plant, const RayGrid& grid, std::vector<float>& ceiling_m) const;

  const farm::Farm& farm_;
  terrain::Border border_;
  double margin_m_;
  std::vector<Maps> maps_;  // of the models
  // The plants by squares of the ground, row by row: those of square i are
  // plants_[first_[i]] to plants_[first_[i + 1]].
  Eigen::AlignedBox2d feet_;
  double reach_m_ = 0;  // of the widest plant
  double side_m_ = 1;
  Eigen::Index columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> first_, plants_;
};

}  // namespace plotscan::lidar
