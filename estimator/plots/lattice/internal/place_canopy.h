// SPDX-License-Identifier: Apache-2.0
#pragma once

// The canopy at a place of a lattice.

#include <algorithm>
#include <array>

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// Where the usual side shows less contrast there is no edge to miss: drill rows end within the box,
// plots touch.
inline constexpr double kLeastUsual = 0.2;

// Mean cover within the place's plot, off its edges.
double inner_cover(const Lattice& lattice, const Place& place);

// Cover within two opposite sides of a plot less that beyond them, the mean of both, along the
// sides' middle three quarters.
struct SideContrast {
  double r = 0;  // of the sides across r
  double c = 0;

  double mean() const { return (r + c) / 2; }
  double least() const { return std::min(r, c); }
};
SideContrast contrast_of(const Lattice& lattice, const Place& place);

// The mean contrast of the sides that have gaps beside them: sides at which plots touch show none.
// Of all sides, where plots touch along both axes.
double mean_at_gaps(const Lattice& lattice, const SideContrast& contrast);

// The same of either side across r, before and after the plot.
std::array<double, 2> r_contrasts_of(const Lattice& lattice, const Place& place);

// Mean cover within the plot, off its edges, less that beyond its sides. Where plots touch along
// one axis, what lies beyond the sides there is a neighbour: the rise is that at the other sides,
// of the plot's middle half.
SideContrast rise_of(const Lattice& lattice, const Place& place);

// Medians of either one over the places that hold a plot.
SideContrast usual_sides(const Lattice& lattice,
                         SideContrast (*of_place)(const Lattice& lattice, const Place& place));

// What the usual plot shows.
struct UsualPlot {
  double cover = 0;
  SideContrast contrast = {};
};
UsualPlot usual_plot(const Lattice& lattice);

// The canopy of a lodged plot lies beside the place where it was sown, in part over its neighbour.
// The contrast of a plot's sides moved there, as a share of the usual plot's: of the pair of sides
// that shows less, where it shows most.
double contrast_moved(const Lattice& lattice, const Place& place, const SideContrast& usual);

}  // namespace plotscan::plots
