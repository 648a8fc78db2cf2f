// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "ground/surface.h"
#include "view/internal/height_colours.h"
#include "view/internal/page.h"

namespace plotscan::view {

inline constexpr Rgb kNoGroundColour{200, 200, 205};

// A cloud as it looks from straight above: for each pixel the highest of its points over the
// ground. Takes any number of points in memory bounded by the picture.
class TopHeights {
 public:
  TopHeights(const Eigen::AlignedBox2d& shown, const Eigen::Vector2i& size_px);

  // Points outside of what is shown are left out.
  void add(std::span<const Eigen::Vector3d> points, const ground::Surface& ground);
  // Number of points that lie in the shown area.
  std::size_t points() const { return points_; }
  // Whether some shown point has no ground under it.
  bool groundless() const { return groundless_; }
  // Height below which that share of the coloured pixels lies; 0 without one.
  double quantile_m(double share) const;
  // White where there is no point, grey where there is no ground under it. Pixels between points
  // are filled as far as the points' density says.
  Raster drawn(const HeightColours& colours) const;

 private:
  int dot_radius_px() const;

  Eigen::AlignedBox2d shown_;
  Eigen::Vector2i size_px_;
  std::vector<float> top_m_;  // by pixel, rows from the lower one up
  std::size_t points_ = 0;
  bool groundless_ = false;
};

}  // namespace plotscan::view
