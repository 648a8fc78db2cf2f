// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: what the sides of a lattice's plots say against their boxes.

#include <vector>

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// By place: whether the canopy of its row or column does not end at one side of the boxes, where
// that of others does. Such plots are narrower or wider than the others, as guard plots are, or
// another crop touches them.
std::vector<bool> without_edge(const Lattice& lattice);

}  // namespace plotscan::plots
