// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/plot_id.h"
#include "estimate/estimate.h"

namespace plotscan::estimate {

// What the height in a column "height_cm" is called: which of the plants' heights it is, nobody
// says.
inline constexpr const char* kUnnamedHeight = "height_hand_m";

// Heights that people measured in some plots, by property ("height_mean_m"), metres.
struct MeasuredHeights {
  std::filesystem::path file;
  std::string id_column;
  std::map<PlotId, std::map<std::string, double>> plots_m = {};
};

// Reads a table (read_csv_table) with a line for each plot: its id, in the column `id_column` (else
// the first there is of plot_id_properties()), and heights in columns height_<name>_<unit>,
// canopy_<name>_<unit> or height_<unit> (kUnnamedHeight), the unit m, cm or mm. An empty field, NA
// and a point are no height; other columns are not read. Throws InputError as read_csv_table does,
// where a column is missing, an id is empty or there twice, a height is no plausible number, and
// where there is none.
MeasuredHeights read_measured_heights(const std::filesystem::path& file,
                                      const std::optional<std::string>& id_column = std::nullopt);

// The measured plots that the estimate lacks. Throws InputError where it lacks all of them.
std::vector<PlotId> not_found(const MeasuredHeights& measured, const Estimate& estimate);

}  // namespace plotscan::estimate
