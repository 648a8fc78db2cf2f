// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <Eigen/Core>

#include "core/coordinate_units.h"
#include "ground/surface.h"

namespace plotscan::estimate {

// Writes a surface as three ESRI ASCII grids, one node a cell, into an existing folder, for QGIS,
// GDAL and R: ground.asc (height), ground_se.asc (its standard error), -9999 out of reach, and
// ground_seen.asc (1 where ground returns show it, 0 where it is interpolated, -9999 out of reach).
// The files' numbers are in `units`; heights and standard errors in the unit of z. Where GDAL knows
// the coordinate system `crs` ("EPSG:<code>" or well-known text), a .prj beside each grid describes
// it; in feet of a system in metres, and in a build without GDAL, there is none. Throws WriteError
// when the files cannot be written.
void write_ground(const std::filesystem::path& folder, const ground::Surface& surface,
                  const CoordinateUnits& units = {}, const std::string& crs = "");

// The highest of the points (x, y, height above the ground; the grid's frame) in each cell of a
// grid, whose centre is its node; NaN where none lies.
ground::Field highest_in_cells(std::span<const Eigen::Vector3f> heights, const ground::Grid& grid);

// Writes chm.asc, a canopy height model on the cells of the ground's grids: `canopy_m` of its
// nodes, -9999 where that is NaN; and chm.prj. Units, system and errors as in write_ground.
void write_canopy(const std::filesystem::path& folder, const ground::Grid& grid,
                  const ground::Field& canopy_m, const CoordinateUnits& units = {},
                  const std::string& crs = "");

// Reads the three grids of such a folder back, Plotscan's or another program's (lower left corner
// or centre, any line breaks, any value for no data); `noise_m` is not in them and stays 0. Throws
// InputError when one is missing, is no ESRI ASCII grid, or has other nodes than the first.
ground::Surface read_ground(const std::filesystem::path& folder, const CoordinateUnits& units = {});

}  // namespace plotscan::estimate
