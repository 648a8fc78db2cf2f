// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "heights/measure_heights.h"

namespace plotscan::heights {

// The part of a plot that holds its own plants.
struct OwnPart {
  PlotBox box = {};      // the plot's, narrower at sides over which a neighbour's plants reach
  bool reached = false;  // whether it is narrower
};

// The own part of each plot, in their order. At a side where another plot ends within 0.6 m whose
// canopy is taller by 5 cm, strips of 10 cm are left out, from the side on, as long as more than
// 3 % of their returns lie above 99 % of those in the plot's middle. The middle, all that is
// farther than half a metre or a third of the plot from its sides, is always kept. Own choice,
// docs/plot-heights.md.
std::vector<OwnPart> own_parts(std::span<const PlotPoints> plots, int threads);

}  // namespace plotscan::heights
