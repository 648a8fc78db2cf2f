// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "farm/description.h"
#include "farm/farm.h"

namespace plotscan::farm {

// Plants drawn into every plot (FACTS: position uniform in the plot or drilled in rows, yaw uniform
// in [0, 2 pi), each axis' scale uniform in [min, max], one of the models), feet on the terrain,
// heights measured. A plant's draws depend on the seed and its id alone.
std::vector<Plant> random_plants(const PlantsDescription& description,
                                 const std::vector<Plot>& plots,
                                 const std::vector<PlantModel>& models, const Terrain& terrain,
                                 std::uint64_t seed);

// The plants of a table, feet on the terrain where the table gives no z, heights measured. A plant
// without a plot of its own belongs to the plot that contains its stem. Throws InputError on a
// broken table, a plant off the terrain or a plot that does not exist.
std::vector<Plant> table_plants(const LayoutDescription& layout, const std::vector<Plot>& plots,
                                const std::vector<PlantModel>& models, const Terrain& terrain);

}  // namespace plotscan::farm
