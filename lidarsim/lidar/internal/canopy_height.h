// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farm/farm.h"

namespace plotscan::lidar {

// Sets every plot's `canopy`: percentiles of the height above the terrain of what noise-free rays
// hit that are cast straight down over the plot's box, on a grid of at most kCanopyStep_m along
// both its axes, each ray in the middle of its cell. The ground's height is 0; all else counts,
// weeds and neighbours' leaves too; masks let rays through. Where the farm's boxes would take more
// than kMostCanopyRays together, the grid is that much coarser. The same for any number of threads.
// Throws InputError when a plant names a missing model.
void measure_canopies(farm::Farm& farm, int threads);

inline constexpr double kCanopyStep_m = 0.01;
inline constexpr double kMostCanopyRays = 40e6;

}  // namespace plotscan::lidar
