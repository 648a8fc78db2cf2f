// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "planting/plants_description.h"

namespace plotscan {
class YamlSection;
}

namespace plotscan::description {

// The `plants` section of farm.yaml (docs/farm-format.md); its models are appended to `models`.
// Throws InputError as load_description does.
planting::PlantsDescription read_plants(const YamlSection& section,
                                        const planting::PlotGridDescription& grid,
                                        std::vector<planting::ModelDescription>& models);

}  // namespace plotscan::description
