// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: the canopy at a place of a lattice.

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// Mean cover within the place's plot, off its edges.
double inner_cover(const Lattice& lattice, const Place& place);

// Cover within two opposite sides of a plot less that beyond them, the mean of both, along the
// sides' middle three quarters.
struct SideContrast {
  double r = 0;  // of the sides across r
  double c = 0;

  double mean() const { return (r + c) / 2; }
};
SideContrast contrast_of(const Lattice& lattice, const Place& place);

// Mean cover within the plot, off its edges, less that beyond its sides.
SideContrast rise_of(const Lattice& lattice, const Place& place);

}  // namespace plotscan::plots
