// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: how sure the plots' boxes are.

#include "core/plot_box.h"
#include "plots/hints.h"
#include "plots/internal/lattice.h"

namespace plotscan::plots {

// The same for all plots of the lattice. A centre's errors are those of the lattice through all
// centres; sides that were told have none.
PlotBoxError box_error(const Lattice& lattice, const Hints& hints);

}  // namespace plotscan::plots
