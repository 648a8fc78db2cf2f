// SPDX-License-Identifier: Apache-2.0
#pragma once

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

// Whether a truth is a table of heights: a file .csv, .tsv or .txt. Throws InputError if it is none
// and `id_column` names a column of one.
bool is_measured_table(const std::filesystem::path& truth,
                       const std::optional<std::string>& id_column = std::nullopt);

// Reads a table as estimate::read_measured_heights does. Throws InputError as that does, and where
// no plot of the table is in the estimate.
MeasuredPlots read_measured(const std::filesystem::path& table, const estimate::Estimate& estimate,
                            const std::optional<std::string>& id_column = std::nullopt);

}  // namespace plotscan::score
