// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "planting/farm_description.h"

#include "farm/farm.h"

namespace plotscan::planting {

// The plants of a table, feet on the terrain where the table gives no z, heights measured. A plant
// without a plot of its own belongs to the plot that contains its stem. Throws InputError on a
// broken table, a plant off the terrain or a plot that does not exist.
std::vector<farm::Plant> table_plants(const LayoutDescription& layout,
                                      const std::vector<farm::Plot>& plots,
                                      const std::vector<farm::PlantModel>& models,
                                      const terrain::Terrain& terrain);

}  // namespace plotscan::planting
