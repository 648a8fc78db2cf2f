// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: the size that all plots of a lattice share.

#include "plots/lattice.h"

namespace plotscan::plots {

struct EdgeFit {
  double size_m = 0;  // of the sown area
  double blur_m = 0;  // sigma of the leaves' spread over the edge
  double rms = 0;     // of the optical depth about the model, over a full plot's
};

// Size of the plots along r or along c. The cover of all plots is pooled about their centres; its
// optical depth, -ln(1 - cover), adds where canopies overlap (Beer-Lambert), so it is fitted as a
// box blurred by a normal kernel, on a level of its own, and the same box at the neighbours.
EdgeFit fit_edges(const Lattice& lattice, bool along_r);

}  // namespace plotscan::plots
