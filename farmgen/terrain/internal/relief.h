// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "terrain/internal/lattice.h"
#include "terrain/internal/plane_waves.h"
#include "terrain/terrain_description.h"

namespace plotscan::terrain {

// The relief that a description adds to its base's heights: slope and rolling everywhere, furrows
// and clods within a rectangle, fading out at its border.
class Relief {
 public:
  // `detail` bounds furrows and clods; they reach full height fade_m inside it.
  Relief(const TerrainDescription& description, const Eigen::AlignedBox2d& detail, double fade_m,
         std::uint64_t seed);

  // Metres above the base at a point.
  double height(const Eigen::Vector2d& point) const;
  // The same at every point of a lattice, rows x columns.
  Eigen::MatrixXd heights(const Lattice& lattice) const;

 private:
  double slope_height(const Eigen::Vector2d& point) const;
  double furrows_height(const Eigen::Vector2d& point) const;
  double share_of_detail(const Eigen::Vector2d& point) const;

  std::optional<SlopeDescription> slope_;
  std::optional<FurrowsDescription> furrows_;
  std::vector<PlaneWave> rolling_;
  std::vector<PlaneWave> clods_;
  Eigen::AlignedBox2d detail_;
  double fade_m_;
};

// Height of a ridge-and-furrow profile at a distance across the ridges from the top of one: in
// [-depth_m / 2, depth_m / 2]. A sine, or a trapezoid whose top, bottom and two flanks are each a
// quarter of the spacing wide.
double furrow_height(const FurrowsDescription& furrows, double across_m);

}  // namespace plotscan::terrain
