// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: where each plot's canopy lies by itself.

#include <optional>
#include <vector>

#include "plots/internal/lattice.h"

namespace plotscan::plots {

// By how much every place's canopy is off its centre along r, metres: where both edges of a box are
// steepest together in its cover, what its neighbours add taken away first. Nothing where that lies
// at the end of what is tried.
std::vector<std::optional<double>> measured_shifts(const Lattice& lattice);

}  // namespace plotscan::plots
