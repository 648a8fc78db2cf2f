// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "farm/farm.h"

namespace plotscan::farm {

// Highest vertex of the placed mesh minus `ground_z`, metres. Constant time for a plant that stands
// upright; over all vertices for one that leans.
double placed_height(const PlantModel& model, const Plant& plant, double ground_z);

// The named truths of a plot with these plants' heights; all zero without plants. The three plants
// of hand3 are drawn without replacement by (seed, plot id); all plants where there are fewer.
PlotHeights plot_heights(const std::vector<double>& plant_heights, std::uint64_t seed,
                         std::uint32_t plot_id);

}  // namespace plotscan::farm
