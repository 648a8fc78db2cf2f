// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "cloud/internal/tiled_points.h"

namespace plotscan::cloud {

struct OutlierOptions {
  // From the median height of the ground and crop within 2 m: trees, birds, clouds, mirror images.
  double farthest_m = 10;
  // Lonely points are left out too, where they lie this far below (above) everything within 7 m
  // that is not lonely: multipath below the ground, low birds, drops. A lonely point shares 3 m x
  // 3 m x 1.5 m with at most this many in all, and with at most this share of the points over
  // these 9 square metres: few returns from the ground under a closed canopy are not lonely in
  // clouds that are dense enough to tell.
  double lonely_margin_m = 0.5;
  std::size_t lonely_points = 4;
  double lonely_share = 0.002;
  int threads = 1;
};

// Takes out points that can be neither ground nor crop, by how far they are from the others around
// them: no slope, relief or edge of a tall crop is cut. Returns how many. What lies nearer is left
// to the fit of the ground, which is robust.
std::size_t drop_outliers(TiledPoints& cloud, const OutlierOptions& options);

}  // namespace plotscan::cloud
