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
// `first_number`: of the first plot, where the section does not say it.
planting::PlotGridDescription read_plot_grid(const YamlSection& section,
                                             std::uint32_t first_number = 1);

// The farm's trials: the entries of its `trials`, or the one that its `plots` and `plants` are.
// Their models are appended to `models`. `sown`: they have plants. None where there is no such key.
std::vector<planting::TrialDescription> read_trials(
    const YamlSection& farm, bool sown, std::vector<planting::ModelDescription>& models);

// The most seeds that all trials of a farm may have.
inline constexpr std::uint64_t kMostSeedsOfFarm = 10'000'000;

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
