// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: where each plot's canopy lies by itself.

#include <optional>
#include <vector>

#include "plots/internal/lattice.h"

namespace plotscan::plots {

// By how much every place's canopy is off its centre along r or c, metres: its depth fitted by a
// blurred box of the lattice's size, what its neighbours add taken away first. Nothing where the
// fit runs away.
std::vector<std::optional<double>> measured_shifts(const Lattice& lattice, bool along_r);

}  // namespace plotscan::plots
