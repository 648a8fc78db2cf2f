// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: whether plots have straight sides.

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// How much better rectangular shapes than round ones explain the mean canopy in and around all
// plots: a ratio of misfits, above 1 where sides are straight.
struct Squareness {
  // Residual squares of two levels, inside and outside an ellipse, over those with a rectangle. Few
  // returns suffice.
  double of_outline = 0;
  // Residual squares of any function of the elliptic distance from the centre (crowns, mounds),
  // over those of any product of a function along and one across (rows, sides that leaves hang
  // over). Both with 0.05 of the canopy's variation added: where both leave little, neither is
  // better. Clear with many returns; with few it is near 1, as noise is no such product.
  double of_canopy = 0;
};
Squareness squareness_of(const Lattice& lattice);

}  // namespace plotscan::plots
