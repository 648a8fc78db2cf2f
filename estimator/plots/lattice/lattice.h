// SPDX-License-Identifier: Apache-2.0
#pragma once

// The lattice on which a field's plots lie, and which of its places hold one.

#include <cstddef>
#include <optional>
#include <vector>

#include "core/plot_box.h"
#include "core/trial_layout.h"
#include "plots/hints.h"
#include "plots/layout/layout.h"

namespace plotscan::plots {

// A place of the lattice. Coordinates are the view's, metres.
struct Place {
  int row = 0, column = 0;  // from 0
  double r_m = 0, c_m = 0;  // centre
  double share = 0;         // its canopy as a share of a full plot's
  double contrast = 0;      // of its sides, as a share of a full plot's
  bool full = false;        // holds a plot,
  bool low = false;         // which is much lower than the usual one,
  bool lodged = false;      // or covers its place and shows no edges there
};

// What the plots have in common along one of the view's axes, metres.
struct Side {
  double size_m = 0;    // of a plot
  double band_m = 0;    // of the layout's bands
  double blur_m = 0.1;  // sigma of the leaves' spread over the edges
  double pitch_m = 0;   // 0 where there is one row or one column only
  // Of plots that touch, their side: the step from one to the next is known.
  std::optional<double> touching_m = std::nullopt;
  double rms_m = 0;       // plots' centres about the lattice
  double parameters = 0;  // of the lattice, that the centres were fitted by
};

struct Lattice {
  RowView view;
  Side r, c;
  int rows = 0, columns = 0;
  bool aligned = true;        // columns run through all rows; else every row has its own offset
  double r_per_c = 0;         // how far a row's plots move along r for every metre along c
  double c_per_r = 0;         // how far a column's plots move along c for every metre along r
  double contrast = 0;        // median of the plots' sides
  double turn_error_rad = 0;  // standard error of the rows' and columns' direction
  std::vector<Place> places = {};

  // The same with r and c exchanged, for what is measured along either axis alike.
  Lattice turned() const;
};

// Cells [r0, r1) x [c0, c1) of the lattice's raster.
struct CellBox {
  int r0 = 0, r1 = 0, c0 = 0, c1 = 0;
};

// The cells of a place's plot, widened by around_m on each side.
CellBox cells_about(const Lattice& lattice, const Place& place, double around_m);

// The lattice through those of a layout's plots that hold canopy; where the user gave the number of
// plots, through the plots with the most canopy. In low_leaves every leaf counts, however low:
// there plots show that are much lower than the usual one; `own` has only the plots' own crop.
Lattice fit_lattice(const Layout& layout, const Hints& hints,
                    const CanopyRaster* low_leaves = nullptr, const CanopyRaster* own = nullptr);

// The same as a layout of plots, their length the longer side.
TrialLayout layout_of(const Lattice& lattice);

// Moves the places to where their canopy lies, smoothed by the lattice. Rows are straight, and
// steps are equal except at alleys that clearly differ. Columns are straight where they are
// aligned; else every row has its own offset and the common pitch.
void straighten(Lattice& lattice);

// Measures size and blur of the lattice's two axes. The cover of all plots is pooled about their
// centres; its optical depth is fitted as a blurred box, on a level of its own, and the same box at
// the neighbours; the size is where the depth falls through half.
void fit_edges(Lattice& lattice);

// Standard errors of a box, the same for all plots of the lattice. Errors of a centre are those of
// the lattice fitted to all centres; a side that the user gave has none.
PlotBoxError box_error(const Lattice& lattice, const Hints& hints);

// By place: whether most plots of its row or column show no edge at one of their sides, where
// others do. Such plots are narrower or wider than the others, as guard plots are, pieces of a
// strip that runs on, or another crop touches them.
std::vector<bool> without_edge(const Lattice& lattice);

// How many places show no edge at one of their sides, where others do: if they are many, the
// lattice is not that of their plots.
std::size_t count_edgeless(const Lattice& lattice);

}  // namespace plotscan::plots
