// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: how well a layout explains a field, cell by cell.

#include "plots/internal/layout.h"

namespace plotscan::plots {

// Schwarz's criterion of the layout: its likelihood, with the lines on which plots begin as
// parameters. Canopy levels do not count as parameters: in every layout each piece of canopy has
// its own, so a layout with more plots does not fit an uneven canopy better.
double criterion(const Layout& layout);

}  // namespace plotscan::plots
