// SPDX-License-Identifier: Apache-2.0
#pragma once

// A canopy raster as rows of plots see it.

#include <vector>

#include "plots/canopy/canopy_raster.h"

namespace plotscan::plots {

// Cells [begin, end) on a line.
struct Band {
  int begin = 0;
  int end = 0;

  int size() const { return end - begin; }
  double middle() const { return 0.5 * (begin + end); }
};

// One after the other; their sizes differ by a cell at most.
inline std::vector<Band> equal_parts(const Band& band, int count) {
  std::vector<Band> parts;
  parts.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    parts.push_back(
        {band.begin + band.size() * i / count, band.begin + band.size() * (i + 1) / count});
  return parts;
}

// Cells so near see the same leaves. Chosen.
inline constexpr double kLeaf_m = 0.3;

// A raster seen with its rows of plots across: `r` counts cells from row to row, `c` along a row.
struct RowView {
  const CanopyRaster* raster = nullptr;
  bool swapped = false;  // rows follow each other along the raster's b axis instead of a

  RowView turned() const { return {.raster = raster, .swapped = !swapped}; }
  int r_cells() const { return swapped ? raster->b_cells() : raster->a_cells(); }
  int c_cells() const { return swapped ? raster->a_cells() : raster->b_cells(); }
  double cell_m() const { return raster->cell_m(); }
  double cover(int r0, int r1, int c0, int c1) const {
    return swapped ? raster->cover(c0, c1, r0, r1) : raster->cover(r0, r1, c0, c1);
  }
  double seen_cells(int r0, int r1, int c0, int c1) const {
    return swapped ? raster->seen_cells(c0, c1, r0, r1) : raster->seen_cells(r0, r1, c0, c1);
  }
  Eigen::Vector2d to_world(double r_m, double c_m) const {
    const Eigen::Vector2d ab = swapped ? Eigen::Vector2d(c_m, r_m) : Eigen::Vector2d(r_m, c_m);
    return raster->frame().to_world(ab);
  }
  Eigen::Vector2d r_axis() const {
    return swapped ? raster->frame().b_axis : raster->frame().a_axis;
  }
  Eigen::Vector2d c_axis() const {
    return swapped ? raster->frame().a_axis : raster->frame().b_axis;
  }
};

}  // namespace plotscan::plots
