// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: the size that all plots of a lattice share.

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// Measures size and blur of the lattice's two axes. The cover of all plots is
// pooled about their centres; its optical depth is fitted as a blurred box, on a level of its own,
// and the same box at the neighbours; the size is where the depth falls through half.
void fit_edges(Lattice& lattice);

}  // namespace plotscan::plots
