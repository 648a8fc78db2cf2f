// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "terrain/terrain.h"
#include "terrain/terrain_description.h"

namespace plotscan::terrain {

// A terrain with a vertex for each pixel of a grey image, centred on the origin, each square of
// four pixels two triangles. Throws InputError on a file that is no grey PNG, or a broken one, or
// on more pixels than kMostTerrainVertices.
Terrain heightmap_terrain(const HeightmapDescription& description);

}  // namespace plotscan::terrain
