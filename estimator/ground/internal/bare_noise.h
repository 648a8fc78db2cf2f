// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "ground/columns.h"

namespace plotscan::ground {

// Least noise, metres: from a lidar's range steps and the ground's own grain.
inline constexpr double kLeastNoise_m = 0.003;

// How the returns of a block of columns, of about the usual density, scatter. A block is one
// column, or up to 0.8 m wide where usual columns have too few returns.
struct BlockSpread {
  std::size_t node = 0;  // its first column
  double width_m = 0;
  double sigma_m = 0;  // about the block's own plane
  double range_m = 0;  // from the lowest return to the highest
};

// Of the density at which the middle return lies; if the noise of these is none of a sensor, of the
// middle column's: trees beside a field, and canopies after a voxel filter, are denser than ground.
std::vector<BlockSpread> block_spreads(const Columns& columns);

// Sigma of the returns' heights about bare ground, metres: the 20th percentile of the blocks', or
// of those that may be bare where fewer are. Assumes that a hundredth is. Without enough blocks it
// is 3 cm. No less than kLeastNoise_m.
double bare_noise_m(const std::vector<BlockSpread>& blocks);

// How much more, in quadrature, the returns about bare ground scatter near a node than noise_m,
// where that is clear; else 0. Strips that lie apart in height do that where they overlap, and the
// ground may lie on either.
Field noise_excess_m(const Grid& grid, const std::vector<BlockSpread>& blocks, double noise_m);

}  // namespace plotscan::ground
