// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farm/terrain.h"
#include "farm/terrain_description.h"

namespace plotscan::farm {

// A terrain with a vertex for each pixel of a grey image, centred on the origin, each square of
// four pixels two triangles. Throws InputError on a file that is no grey PNG, or a broken one, or
// on more pixels than kMostTerrainVertices.
Terrain heightmap_terrain(const HeightmapDescription& description);

}  // namespace plotscan::farm
