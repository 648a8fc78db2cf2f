// SPDX-License-Identifier: Apache-2.0
#include "score/measured_table.h"

#include <array>

#include "core/contains.h"
#include "core/text.h"
#include "estimate/measured_heights.h"

namespace plotscan::score {
namespace fs = std::filesystem;

bool is_measured_table(const fs::path& truth, const std::optional<std::string>& id_column) {
  constexpr std::array<const char*, 3> kTables = {".csv", ".tsv", ".txt"};
  const bool is_table = !fs::is_directory(truth) && contains(kTables, lower_extension(truth));
  if (id_column && !is_table)
    throw InputError("--id names a column of a table of measured heights, and the truth is none");
  return is_table;
}

MeasuredPlots read_measured(const fs::path& table, const estimate::Estimate& estimate,
                            const std::optional<std::string>& id_column) {
  const estimate::MeasuredHeights measured = estimate::read_measured_heights(table, id_column);
  MeasuredPlots truth{.id_column = measured.id_column,
                      .not_found = estimate::not_found(measured, estimate)};
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    const auto found = measured.plots_m.find(plot.id);
    const bool scored = found != measured.plots_m.end();
    truth.plots.push_back({.id = plot.id,
                           .trial = plot.trial,
                           .row = plot.row,
                           .column = plot.column,
                           .box = plot.box,
                           .scored = scored});
    if (scored) truth.plots.back().heights_m = found->second;
  }
  return truth;
}

}  // namespace plotscan::score
