// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "farm/farm.h"

namespace plotscan::farm {

// truth/plots.geojson: boxes, ids, rows, columns, plant counts and heights (docs/farm-format.md).
void write_plots(const std::filesystem::path& path, const std::vector<Plot>& plots);

// truth/plots_wgs84.geojson: the same polygons and attributes, the corners as longitude and
// latitude of their places on the horizontal plane through the anchor.
void write_plots_wgs84(const std::filesystem::path& path, const std::vector<Plot>& plots,
                       const Anchor& anchor);

// Reads what write_plots writes. Throws InputError on a missing or non-finite attribute, or an id
// given twice.
std::vector<Plot> read_plots(const std::filesystem::path& path);

// Boxes alone, from any plots.geojson: the id is the "plot" attribute where all features have it,
// else the place in the file from 1. Row and column likewise, else row 1.
std::vector<Plot> read_plot_boxes(const std::filesystem::path& path);

}  // namespace plotscan::farm
