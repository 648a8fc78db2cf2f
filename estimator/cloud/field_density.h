// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "cloud/area.h"
#include "cloud/tile_store.h"

namespace plotscan::cloud {

// Densities, points per square metre, at which plots were still found and no longer found
// (docs/real-clouds-tests.md).
inline constexpr double kPlotsFound_m2 = 65;
inline constexpr double kPlotsLost_m2 = 20;
// Below this density plots are not searched, even if they are much larger than the tested ones.
inline constexpr double kLeastSearched_m2 = kPlotsLost_m2 / 2;

// Counts points by tile, except points too far away for a tile's number. Memory grows with the area
// over which the points lie.
class TileCounter {
 public:
  void add(std::span<const Eigen::Vector3d> points);  // metres
  // In the tiles' order.
  std::vector<TileCount> counts() const;

 private:
  std::unordered_map<std::uint64_t, std::uint64_t> count_by_tile_;
};

// Throws InputError if no point of the cloud called `name` was within reach (is_in_reach).
void require_places(std::span<const TileCount> counts, const std::string& name);

// How densely a field was scanned.
struct FieldDensity {
  Area field{};        // bounds of the densely scanned field (find_field), metres
  double area_m2 = 0;  // of its outline
  // Points per square metre over all squares inside the outline, empty ones included: median and 5
  // % quantile.
  double median = 0;
  double least5 = 0;
  int square_m = 1;  // the smallest of 1, 2, 4, ... 256 m with 16 points in the median square
};

// At least one tile.
FieldDensity field_density(std::span<const TileCount> counts);

// Points a square metre, as people read them: "3040", "12.5", "0.6".
std::string density_text(double per_m2);

}  // namespace plotscan::cloud
