// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "cloud/internal/tiled_points.h"

namespace plotscan::cloud {

struct HazeOptions {
  // Greatest distance from a tile's level (tile_levels); farther points are for drop_outliers.
  double farthest_m = 10;
  // A point is alone when the cube around it holds at most `alone` points, itself included. The
  // cube is as wide as a square that holds `column_points` of the tile's returns, 0.3 to 3 m. On
  // the ground or in a low canopy a cube holds all of these; of a haze that has 1 in 100 returns,
  // spread over 20 m of height, it holds 0.02 to 0.2.
  std::size_t alone = 2;
  double column_points = 60;
  int threads = 1;
};

// Takes out a haze: stray returns (dust, rain, sunlight, crosstalk) spread through the air above
// the canopy and below the ground. A stray has no neighbours at the canopy's own spacing. A few
// tips of plants have none either, and single returns under a closed canopy: points that are alone
// are taken out only where the air is full of such points. Counted are those in the same and the
// next 8 blocks of 8 m, by half metres of height over their tiles' levels. The haze begins at the
// first half metre from the level upwards with no more of them (at most twice as many, and 3
// standard deviations of Poisson) than the lower quartile of the next 12, of which 3 m of maize
// fill 6: a haze that does not reach 5 m up stays. Below the level they are taken out of the half
// metres that hold no more than the haze above, or the next 12 below: where the ground under a
// closed canopy lies there are more. Clouds
// without a haze keep all their points. Tiles with less than 3 points a square metre are left as
// they are: nobody can tell there. Returns how many points are taken out.
std::size_t drop_haze(TiledPoints& cloud, const HazeOptions& options);

}  // namespace plotscan::cloud
