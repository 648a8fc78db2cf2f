// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: the rows that plots are sown in.

#include <optional>

#include "plots/lattice/lattice.h"
#include "plots/plot_field.h"

namespace plotscan::plots {

// The rows that follow each other along r in every plot, where the mean canopy of all plots shows
// them; none where an even canopy explains it nearly as well.
std::optional<SownRows> sown_rows_along(const Lattice& lattice);

}  // namespace plotscan::plots
