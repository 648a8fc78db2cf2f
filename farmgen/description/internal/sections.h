// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "planting/farm_description.h"

namespace plotscan {
class YamlSection;
}

// The sections of farm.yaml (docs/farm-format.md). All throw InputError as load_description does.
namespace plotscan::description {

terrain::TerrainDescription read_terrain(const YamlSection& section);
planting::PlotGridDescription read_plot_grid(const YamlSection& section);

// Reads the list at the section's key "models", appends the entries that `models` does not hold
// yet, and returns the indices of all in `models`. Throws also when two entries of the list, or two
// different models, have one name.
std::vector<std::uint32_t> read_models(const YamlSection& section,
                                       std::vector<planting::ModelDescription>& models);

// The models of plants and weeds are appended to `models`.
planting::PlantsDescription read_plants(const YamlSection& section,
                                        const planting::PlotGridDescription& grid,
                                        std::vector<planting::ModelDescription>& models);
planting::WeedsDescription read_weeds(const YamlSection& section,
                                      std::vector<planting::ModelDescription>& models);

}  // namespace plotscan::description
