// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: whether the gaps between plots are emptier than the plots.

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// Cover of the gaps from plot to plot over that of the plots on either side, in the mean and three
// standard errors more; along the axis where it is larger. 0 where no plot has a neighbour. Pieces
// cut out of a row that runs on, as of vines, have 0.96 and more.
double gap_cover(const Lattice& lattice);

}  // namespace plotscan::plots
