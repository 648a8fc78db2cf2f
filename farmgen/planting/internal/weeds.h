// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "planting/weeds_description.h"

#include "farm/farm.h"

namespace plotscan::planting {

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
