// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: what the sides of a lattice's plots say against their boxes.

#include <cstddef>
#include <vector>

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// By place: whether most plots of its row or column show no edge at one of their sides, where
// others do. Such plots are narrower or wider than the others, as guard plots are, pieces of a
// strip that runs on, or another crop touches them.
std::vector<bool> without_edge(const Lattice& lattice);

// How many places show no edge at one of their sides, where others do: if they are many, the
// lattice is not that of their plots.
std::size_t count_edgeless(const Lattice& lattice);

}  // namespace plotscan::plots
