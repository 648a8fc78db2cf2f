// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farm/farm.h"

namespace plotscan::lidar {

// Sets every plot's `canopy`: percentiles of canopy height, metres above the terrain. Noise-free
// rays are cast straight down over the plot's box, one in the middle of each cell of a grid whose
// cells measure at most kCanopyStep_m along both axes of the box. A hit on the ground has height 0;
// all else counts, weeds and neighbours' leaves too; rays pass through holes of masks. If the farm
// would take more than kMostCanopyRays, the grid is coarser. The same for any number of threads.
// Throws InputError when a plant names a missing model.
void measure_canopies(farm::Farm& farm, int threads);

inline constexpr double kCanopyStep_m = 0.01;
inline constexpr double kMostCanopyRays = 40e6;

}  // namespace plotscan::lidar
