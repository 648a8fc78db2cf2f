// SPDX-License-Identifier: Apache-2.0
#pragma once

// Where each plot's canopy lies by itself.

#include <optional>
#include <vector>

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// How far each place's canopy lies from the place's centre along r, metres: the shift at which both
// edges of a box are steepest together in the cover, after the neighbours' part is subtracted.
// Nothing where that is the largest shift that is tried.
std::vector<std::optional<double>> measured_shifts(const Lattice& lattice);

}  // namespace plotscan::plots
