// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: how sure the plots' boxes are.

#include "core/plot_box.h"
#include "plots/hints.h"
#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// Standard errors of a box, the same for all plots of the lattice. Errors of a centre are those of
// the lattice fitted to all centres; a side that the user gave has none.
PlotBoxError box_error(const Lattice& lattice, const Hints& hints);

}  // namespace plotscan::plots
