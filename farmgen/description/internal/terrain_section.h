// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "terrain/terrain_description.h"

namespace plotscan {
class YamlSection;
}

namespace plotscan::description {

// The `terrain` section of farm.yaml (docs/farm-format.md). Throws InputError as load_description
// does.
terrain::TerrainDescription read_terrain(const YamlSection& section);

}  // namespace plotscan::description
