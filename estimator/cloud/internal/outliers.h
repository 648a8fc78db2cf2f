// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "cloud/internal/tiled_points.h"

namespace plotscan::cloud {

struct OutlierOptions {
  // Greatest distance from the median height of ground and crop within 2 m. Farther points are
  // trees, birds, clouds, mirror images.
  double farthest_m = 10;
  // Lonely points are left out too, where they lie this far below (above) all points within 7 m
  // that are not lonely: multipath below the ground, low birds, drops. A point is lonely when the 3
  // m x 3 m x 1.5 m around it hold at most this many points in all, and at most this share of the
  // points over these 9 square metres. So the few ground returns under a closed canopy are not
  // lonely in a cloud that is dense enough.
  double lonely_margin_m = 0.5;
  std::size_t lonely_points = 4;
  double lonely_share = 0.002;
  int threads = 1;
};

// Removes points that can be neither ground nor crop, by their distance from the points around
// them; slopes, relief and edges of tall crops stay. Returns how many were removed. Nearer outliers
// are left to the fit of the ground, which is robust.
std::size_t drop_outliers(TiledPoints& cloud, const OutlierOptions& options);

}  // namespace plotscan::cloud
