// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "farm/farm.h"
#include "planting/farm_description.h"

namespace plotscan::planting {

// Makes the farm that the description and the seed determine. Throws InputError when a mesh or
// table cannot be read, a plot does not lie on the terrain, or a plant stands off it.
farm::Farm generate(const FarmDescription& description, std::uint64_t seed);

}  // namespace plotscan::planting
