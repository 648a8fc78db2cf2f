// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crop/cultivar.h"
#include "crop/plant_builder.h"

namespace plotscan::crop {

// Grows a soybean from the parameters of models/soybean/soybean.yaml: cotyledons, the opposite
// unifoliolate leaves of node 1, trifoliolate leaves on petioles above it, branches from the lowest
// axils, flowers, and pods in clusters.
void grow_soybean(const Traits& traits, std::uint64_t seed, PlantBuilder& plant);

}  // namespace plotscan::crop
