// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "ground/surface.h"

namespace plotscan::estimate {

// Writes a surface as three ESRI ASCII grids, one node a cell, into an existing folder, for QGIS,
// GDAL and R: ground.asc (height), ground_se.asc (its standard error), both in metres, -9999 out of
// reach, and ground_seen.asc (1 where ground returns show it, 0 where it is interpolated, -9999 out
// of reach). Throws InputError when they cannot be written.
void write_ground(const std::filesystem::path& folder, const ground::Surface& surface);

}  // namespace plotscan::estimate
