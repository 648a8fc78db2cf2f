// SPDX-License-Identifier: Apache-2.0
#include "farm/terrain_description.h"

#include "core/yaml_section.h"
#include "farm/description_values.h"

namespace plotscan::farm {
namespace {

constexpr Range kSide = {1, 100000};
constexpr Range kRelief = {0, 1000};
constexpr std::int64_t kMostTerrainVertices = 1'000'000;

}  // namespace

TerrainDescription read_terrain(const YamlSection& section) {
  TerrainDescription terrain;
  if (section.has("mesh")) {
    section.allow_only({"mesh", "up", "unit_m"});
    terrain.mesh = file_at(section, "mesh");
    terrain.mesh_options = read_mesh_options(section);
    return terrain;
  }
  section.allow_only({"side_m", "vertices", "relief_m", "mesh"});
  terrain.side_m = section.number("side_m", kSide);
  terrain.vertices = static_cast<std::uint32_t>(
      section.integer("vertices", 0, kMostTerrainVertices, terrain.vertices));
  terrain.relief_m = section.number("relief_m", kRelief, terrain.relief_m);
  return terrain;
}

std::vector<std::filesystem::path> terrain_files(const TerrainDescription& description) {
  if (description.mesh) return {*description.mesh};
  return {};
}

}  // namespace plotscan::farm
