// SPDX-License-Identifier: Apache-2.0
#include "terrain/terrain_description.h"

namespace plotscan::terrain {

std::vector<std::filesystem::path> terrain_files(const TerrainDescription& description) {
  if (description.mesh) return {*description.mesh};
  if (description.heightmap) return {description.heightmap->image};
  if (description.xyz) return {description.xyz->file};
  return {};
}

}  // namespace plotscan::terrain
