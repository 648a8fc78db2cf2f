// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: whether what lies on a lattice is a field of plots.

#include <cstddef>
#include <string>

#include "plots/lattice.h"

namespace plotscan::plots {

// What tells a field of plots from an orchard, parked cars, bushes, a room.
struct FieldSigns {
  std::size_t plots = 0;
  double held_share = 0;     // of the canopy, in the plots
  double filled_share = 0;   // of the rows' places from their first plot to their last
  double surface_share = 0;  // of what stands on the field, that is smooth as walls and roofs are
  double squareness = 0;     // misfit of ellipses over that of rectangles, as the plots' outlines
  double unevenness = 0;     // spread over mean of the canopy, a square metre at a time, in plots
  double aspect = 0;         // length of a plot over its width
  double evidence = 0;       // for a plot, over one canopy without them: Schwarz's criterion, nats
};

// `lattice` is on a raster of the field's canopy.
FieldSigns signs_of(const Lattice& lattice, const FieldCanopy& field, double evidence);

// Why these are no plots; "" where they are.
std::string no_plots_because(const FieldSigns& signs);

// 0 to 1: how clearly the field is one of plots.
double field_confidence(const FieldSigns& signs);

}  // namespace plotscan::plots
