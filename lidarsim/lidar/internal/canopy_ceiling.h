// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "farm/farm.h"
#include "lidar/internal/ceiling_map.h"
#include "lidar/internal/ray_grid.h"
#include "terrain/border.h"

namespace plotscan::lidar {

// Upper bounds of the canopy's height under vertical rays, found without casting them: of many
// rays, only those that may be among the highest need to be cast. Keeps a reference to the farm,
// which must not change.
class CanopyCeiling {
 public:
  // Every plant's model must exist.
  explicit CanopyCeiling(const farm::Farm& farm);

  // A plant as seen by rays from above.
  struct Standing {
    std::uint32_t plant;  // index into Farm::plants
    const CeilingMap* map;
    Eigen::Matrix2d map_from_world;  // turns and scales
    Eigen::Vector2d foot_m;
    double foot_z_m;
    double z_scale;
    double reach_m;
  };

  // The plants that a ray of the grid can hit, and perhaps a few others.
  std::vector<Standing> plants_near(const RayGrid& grid) const;

  // For each of the grid's rays an upper bound of what it hits, metres above the ground; 0 means
  // that it hits the ground. `near` are the plants near the grid. Absent if a ray may miss the
  // terrain, or if plants stand so close that casting all rays takes no longer.
  std::optional<std::vector<float>> over(const RayGrid& grid,
                                         const std::vector<Standing>& near) const;

  // By how much single precision may displace rays and triangles.
  double margin_m() const { return margin_m_; }

 private:
  struct Maps {
    CeilingMap upright;
    CeilingMap of_any_turn;
  };

  Standing standing(std::uint32_t number) const;
  void sort_plants();
  std::size_t square_of(const Eigen::Vector2d& place) const;
  std::array<Eigen::Index, 2> column_and_row(const Eigen::Vector2d& place) const;
  void raise(const Standing& plant, const RayGrid& grid, std::vector<float>& ceiling_m) const;

  const farm::Farm& farm_;
  terrain::Border border_;
  double margin_m_;
  std::vector<Maps> maps_;  // of the models
  // The plants sorted by squares of the ground, row by row. Square i has plants_[first_[i]] up to,
  // but without, plants_[first_[i + 1]].
  Eigen::AlignedBox2d feet_;
  double reach_m_ = 0;  // of the widest plant
  double side_m_ = 1;
  Eigen::Index columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> first_, plants_;
};

}  // namespace plotscan::lidar
