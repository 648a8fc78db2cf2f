// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "cloud/internal/tiled_points.h"

namespace plotscan::cloud {

// Removes a haze: stray returns (dust, rain, sunlight, crosstalk) spread through the air above the
// canopy and below the ground, within kFarthest_m of their tiles' levels. A stray has no neighbours
// at the canopy's own spacing. Some tips of plants and single returns under a closed canopy have
// none either, so points that are alone are removed only where the air is full of them.
//
// A point is alone when the cube around it holds at most 2 points, itself included. The cube is as
// wide as a square that holds 60 of the tile's returns, 0.3 to 3 m. On the ground or in a low
// canopy a cube holds all of these; of a haze that has 1 in 100 returns, spread over 20 m of
// height, it holds 0.02 to 0.2.
//
// Points that are alone are counted over a block of 8 m and the 8 blocks around it, in slabs of
// half a metre of height over their tiles' levels. The haze begins at the first slab, upwards from
// the level, whose count is at most 2 q + 3 sqrt(2 q), q being the lower quartile of the next 12
// slabs; 3 m of maize fill 6 of these, so a haze that does not reach 5 m up stays. Below the level,
// points that are alone are removed from slabs that pass the same test with the greater of that q
// and the quartile of the next 12 slabs below; the ground under a closed canopy has more and stays.
// Clouds without a haze keep all their points. Tiles with less than 3 points per square metre stay
// as they are: they show too little. Returns the number of removed points.
std::size_t drop_haze(TiledPoints& cloud, int threads);

}  // namespace plotscan::cloud
