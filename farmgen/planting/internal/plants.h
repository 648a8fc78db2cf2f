// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "farm/farm.h"
#include "planting/farm_description.h"

// What grows on a farm.
namespace plotscan::planting {

// Reads or grows the models. Throws InputError when a file cannot be read, a plant cannot be grown
// (naming `source`, the description), has no height, or lacks a material that is given a
// reflectance.
std::vector<farm::PlantModel> make_models(const std::vector<ModelDescription>& models,
                                          const std::filesystem::path& source);

// A plot, what is sown into it, and its first seed's number among all seeds of the farm.
struct SownPlot {
  farm::Plot plot;
  const CultivarDescription* cultivar = nullptr;
  std::uint64_t first_seed = 1;
};

// The plots of the trials that are not missing, with the cultivar and the seeds of each. The seeds
// of missing plots count, so that nothing else changes when a plot is missing. Refers to `trials`,
// all of which have plants.
std::vector<SownPlot> sow(const std::vector<TrialDescription>& trials, std::uint64_t seed);

// The plants that come up: position uniform in the plot or drilled in rows, yaw uniform in
// [0, 2 pi) or along the row, each axis' scale uniform in [min, max] or, along z, from a drawn
// height; one of the cultivar's models; feet on the terrain, heights measured, ids from 1. What is
// drawn for a plant depends on the farm's seed and its own seed's number alone. Throws InputError
// (naming `source`, the description) when a plot lies over a hole of the terrain, or a model would
// have to be stretched too far for its drawn height.
std::vector<farm::Plant> grow_plants(const std::vector<SownPlot>& plots,
                                     const std::vector<farm::PlantModel>& models,
                                     const terrain::Terrain& terrain,
                                     const std::filesystem::path& source, std::uint64_t seed);

// The plants of a table, feet on the terrain where the table gives no z, heights measured. A plant
// without a plot of its own belongs to the plot that contains its stem. Throws InputError on a
// broken table, a plant off the terrain or a plot that does not exist.
std::vector<farm::Plant> table_plants(const LayoutDescription& layout,
                                      const std::vector<farm::Plot>& plots,
                                      const std::vector<farm::PlantModel>& models,
                                      const terrain::Terrain& terrain);

// Weeds at random places of the field. per_m2 gives their number before weeds are removed that
// stand off the terrain or where none are wanted. Their ids are 0; what is drawn for a weed depends
// on the seed and its number alone. Throws InputError (naming `source`) when there are more than a
// million.
std::vector<farm::Plant> draw_weeds(const WeedsDescription& description,
                                    const std::vector<farm::Plot>& plots,
                                    const std::vector<farm::PlantModel>& models,
                                    const terrain::Terrain& terrain,
                                    const std::filesystem::path& source, std::uint64_t seed);

}  // namespace plotscan::planting
