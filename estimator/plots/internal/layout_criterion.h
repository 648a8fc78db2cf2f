// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: how well a layout explains a field, cell by cell.

#include "plots/internal/layout.h"

namespace plotscan::plots {

// Schwarz's criterion of the layout: its likelihood, and the lines on which plots begin. Levels are
// no parameters: whatever the layout, every piece of canopy has its own, so that none fits an
// uneven canopy better for having more plots.
double criterion(const Layout& layout);

}  // namespace plotscan::plots
