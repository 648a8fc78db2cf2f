// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "cloud/internal/tiled_points.h"

namespace plotscan::cloud {

// Removes points that can be neither ground nor crop; slopes, relief and edges of tall crops stay.
// Returns how many were removed. Nearer outliers are left to the fit of the ground, which is
// robust. Removed are
// - points farther than kFarthest_m from their tile's level;
// - lonely points half a metre below (above) all points within 7 m that are not lonely: multipath
//   below the ground, low birds, drops.
// A point is lonely when the 3 m x 3 m x 1.5 m around it hold at most 4 points in all, and at most
// 0.2 % of the points over these 9 square metres. So the few ground returns under a closed canopy
// are not lonely in a cloud that is dense enough.
std::size_t drop_outliers(TiledPoints& cloud, int threads);

}  // namespace plotscan::cloud
