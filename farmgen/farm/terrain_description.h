// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "mesh/mesh_import.h"

namespace plotscan {
class YamlSection;
}

namespace plotscan::farm {

// The `terrain` section of farm.yaml (docs/farm-format.md).
struct TerrainDescription {
  // A mesh file in place of the random square; its z = 0 and origin are the world's.
  std::optional<std::filesystem::path> mesh;
  mesh::MeshImportOptions mesh_options;
  double side_m = 0;
  std::uint32_t vertices = 150;  // random ones, besides the four corners
  double relief_m = 0;           // z of each vertex is uniform in [-relief_m, relief_m]
};

// Throws InputError as load_description does.
TerrainDescription read_terrain(const YamlSection& section);

// The files that the terrain is made from.
std::vector<std::filesystem::path> terrain_files(const TerrainDescription& description);

}  // namespace plotscan::farm
