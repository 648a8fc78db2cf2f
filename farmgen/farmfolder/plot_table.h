// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "farm/farm.h"

namespace plotscan::farmfolder {

// truth/plots.geojson: the plots' boxes and attributes.
void write_plots(const std::filesystem::path& path, const std::vector<farm::Plot>& plots);

// truth/plots_wgs84.geojson: the same polygons and attributes, the corners as longitude and
// latitude of their places on the horizontal plane through the anchor.
void write_plots_wgs84(const std::filesystem::path& path, const std::vector<farm::Plot>& plots,
                       const Anchor& anchor);

// Reads what write_plots writes. Throws InputError on a missing or non-finite attribute, or a
// number given twice.
std::vector<farm::Plot> read_plots(const std::filesystem::path& path);

// Boxes alone, from any plots.geojson: the id is the attribute plot_number, else the place in the
// file from 1. Row, column, replicate, block and accession likewise from their attributes, else
// row 1, the place in the file, 1, 1 and farm::kNoAccession.
std::vector<farm::Plot> read_plot_boxes(const std::filesystem::path& path);

// truth/plots.csv: the trial's layout as breeding databases take it in, plots named after `trial`.
void write_trial_layout(const std::filesystem::path& path, const std::string& trial,
                        const std::vector<farm::Plot>& plots);

}  // namespace plotscan::farmfolder
