// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace plotscan::estimate {

// A raster of values. Node (column, row) lies at first + cell * (column, row), rows from south to
// north, and has index row * columns + column.
struct EsriGrid {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();  // centre of the lower left cell
  double cell = 0;
  int columns = 0;
  int rows = 0;
  std::vector<float> values = {};  // NaN where the file has no data
};

// Reads an ESRI ASCII raster: ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter,
// cellsize and an optional NODATA_value (else -9999), then the values from north to south, each
// line from west to east (ArcMap 10.6, "Esri ASCII raster format"; the default of NODATA_value as
// ArcWorkstation 8.3's help has it). At least 2 x 2 nodes. Throws InputError naming file and line.
EsriGrid read_esri_grid(const std::filesystem::path& path);

}  // namespace plotscan::estimate
