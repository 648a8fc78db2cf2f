// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "terrain/terrain.h"

namespace plotscan::farmfolder {

// truth/terrain.ply: binary little-endian PLY with double x, y, z, so that the terrain reads back
// exactly (mesh libraries hold single precision).
void write_terrain(const std::filesystem::path& path, const terrain::Terrain& terrain);

// Reads what write_terrain writes. Throws InputError when the header is another, the file is
// shorter or longer than the header says, or the terrain is broken.
terrain::Terrain read_terrain(const std::filesystem::path& path);

}  // namespace plotscan::farmfolder
