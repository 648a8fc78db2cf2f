// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crop/cultivar.h"
#include "crop/plant_builder.h"

namespace plotscan::crop {

// Adds a maize plant: a stem of internodes, leaves in two opposite rows whose blades arch over, the
// ear on its node with husk and silks, the tassel. Parameters: models/maize/maize.yaml.
void grow_maize(const Traits& traits, std::uint64_t seed, PlantBuilder& plant);

}  // namespace plotscan::crop
