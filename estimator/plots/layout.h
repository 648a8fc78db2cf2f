// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: rows of plots on a canopy raster.

#include <array>
#include <optional>
#include <vector>

#include "plots/bands.h"
#include "plots/canopy_raster.h"

namespace plotscan::plots {

// A raster seen with its rows of plots across: `r` counts cells from row to row, `c` along a row.
struct RowView {
  const CanopyRaster* raster = nullptr;
  bool swapped = false;  // rows follow each other along the raster's b axis instead of a

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

struct Row {
  Band band;                     // across the row
  std::vector<Band> plots = {};  // along it
};

struct Layout {
  RowView view;
  int r_size = 0, c_size = 0;  // of a plot, cells
  std::vector<Row> rows = {};
  double score = 0;    // metres of edges explained
  double cover = 0;    // mean of the plots'
  double clarity = 0;  // contrast of the weaker pair of sides, as a share of the plots' cover
  double quality = 0;  // of all edges of the plots, times the regularity of their steps; 1 at best
};

// Contrast of a box's sides, in cells: cover within it less cover beyond it, in strips of `reach`
// cells along the middle three quarters of the side.
struct SideContrast {
  std::array<double, 2> across_r = {};  // sides that lie along c, at the box's lowest and highest r
  std::array<double, 2> across_c = {};

  double mean() const;
};
SideContrast side_contrast(const RowView& view, int r0, int r1, int c0, int c1, int reach);

// Sides of the plots that the user knows, metres; either may lie along either axis.
struct KnownSides {
  std::optional<double> width_m = std::nullopt;
  std::optional<double> length_m = std::nullopt;
};

// Whether a side is the given one: leaves lean out over it.
bool is_side(double side_m, const std::optional<double>& known_m);

// The layout of equal plots, of known sides where they are, that explains most edges: bands of rows
// over the whole field, then plots in each row by itself, for either role of the two axes.
Layout best_layout(const CanopyRaster& raster, const KnownSides& known = {});

}  // namespace plotscan::plots
