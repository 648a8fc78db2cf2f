// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crop/cultivar.h"
#include "crop/plant_builder.h"

namespace plotscan::crop {

// Adds a wheat plant: the main shoot and its tillers, each of phytomers whose blades bend over,
// from heading on with an ear of spikelets in two rows and awns. With `tuft_m` above 0 a piece of a
// drill row of that length, along x about the origin. Parameters: models/wheat/wheat.yaml.
void grow_wheat(const Traits& traits, std::uint64_t seed, PlantBuilder& plant);

}  // namespace plotscan::crop
