// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "terrain/terrain.h"
#include "terrain/terrain_description.h"

namespace plotscan::terrain {

struct MadeTerrain {
  Terrain terrain;
  // Where the world's origin lies in the coordinates of the description's file, where that differs.
  std::optional<Eigen::Vector3d> origin_m;
};

// The terrain of a description: its base, and the relief on it, fine enough to show in the plots'
// bounding rectangle. Throws InputError on a file that is broken, and where the relief takes more
// than kMostTerrainVertices or a given step is too coarse for it, saying what would fit; `source`
// is the file that these messages name.
MadeTerrain make_terrain(const TerrainDescription& description, const std::vector<PlotBox>& plots,
                         std::uint64_t seed, const std::filesystem::path& source);

}  // namespace plotscan::terrain
