// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crop/cultivar.h"
#include "crop/plant_builder.h"

namespace plotscan::crop {

// How a crop is drawn: how its organs grow, and how their surfaces look (crop/internal/textures.h).
// Named after the crop that each was made for; others may have the same.
enum class Form { soybean, wheat, maize };

// Each adds a plant, grown from the parameters of models/NAME/NAME.yaml.

// Cotyledons, the opposite unifoliolate leaves of node 1, trifoliolate leaves on petioles above it,
// branches from the lowest axils, flowers, and pods in clusters.
void grow_soybean(const Traits& traits, std::uint64_t seed, PlantBuilder& plant);

// The main shoot and its tillers, each of phytomers whose blades bend over, from heading on with an
// ear of spikelets in two rows and awns. With `tuft_m` above 0 a piece of a drill row of that
// length, along x about the origin.
void grow_wheat(const Traits& traits, std::uint64_t seed, PlantBuilder& plant);

// A stem of internodes, leaves in two opposite rows whose blades arch over, the ear on its node
// with husk and silks, the tassel.
void grow_maize(const Traits& traits, std::uint64_t seed, PlantBuilder& plant);

}  // namespace plotscan::crop
