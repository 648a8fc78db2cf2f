// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: whether plots have straight sides.

#include "plots/internal/lattice.h"

namespace plotscan::plots {

// The mean canopy of all plots and what lies around them, as round things and as plots explain it:
// above 1 where sides are straight.
struct Squareness {
  // Squares that two levels, in an ellipse and around it, leave over those of a rectangle. Few
  // returns suffice.
  double of_outline = 0;
  // Squares that any function of the distance in ellipses leaves (crowns, mounds), over those of
  // any product of a function along and one across (rows, sides that leaves hang over). Clearer
  // where there are many returns; few leave 1, as their noise is no product.
  double of_canopy = 0;
};
Squareness squareness_of(const Lattice& lattice);

}  // namespace plotscan::plots
