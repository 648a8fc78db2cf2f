// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "estimate/estimate.h"
#include "score/score.h"

namespace plotscan::score {

// Heights that people measured in the field, as the truth of an estimate's plots.
struct MeasuredPlots {
  std::string id_column;               // by which plots of table and estimate are one
  std::vector<TruePlot> plots = {};    // the estimate's plots, in its boxes; scored: those measured
  std::vector<PlotId> not_found = {};  // measured, and not in the estimate
};

// Whether a truth is a table of heights: a file .csv, .tsv or .txt.
bool is_measured_table(const std::filesystem::path& truth);

// Reads a table (read_csv_table) with a line for each plot: its id, in the column `id_column` (else
// the first there is of plot_id_properties()), and heights in columns height_<name>_<unit>,
// canopy_<name>_<unit> or height_<unit> (which becomes height_hand_m), the unit m, cm or mm. An
// empty field, NA and a point are no height; other columns are not read. Throws InputError as
// read_csv_table does, where a column is missing, an id is empty or there twice, a height is no
// plausible number, and where no plot of the table is in the estimate.
MeasuredPlots read_measured(const std::filesystem::path& table, const estimate::Estimate& estimate,
                            const std::optional<std::string>& id_column = std::nullopt);

}  // namespace plotscan::score
