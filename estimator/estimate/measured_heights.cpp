// SPDX-License-Identifier: Apache-2.0
#include "estimate/measured_heights.h"

#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "core/contains.h"
#include "core/coordinate_units.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/plot_features.h"
#include "core/text.h"
#include "estimate/height_properties.h"
#include "estimate/internal/table_columns.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;
namespace {

constexpr std::array<const char*, 3> kRulers = {"mm", "cm", "m"};  // units of heights

// A column of heights: the truth that it states, and how many of its units a metre has.
struct HeightColumn {
  std::size_t column;
  std::string truth;
  double per_m;
};

std::optional<HeightColumn> height_column(std::size_t column, const std::string& name) {
  for (const std::string unit : kRulers) {
    if (!name.ends_with("_" + unit)) continue;
    const std::string stem = name.substr(0, name.size() - unit.size() - 1);
    std::string truth = stem == "height" ? kUnnamedHeight : stem + std::string(kSuffix);
    if (height_of(truth).empty()) return std::nullopt;
    return HeightColumn{column, std::move(truth), std::round(1 / unit_named(unit).value())};
  }
  return std::nullopt;
}

std::vector<HeightColumn> height_columns(const fs::path& file, const CsvTable& table) {
  std::vector<HeightColumn> found;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::optional<HeightColumn> column = height_column(i, table.columns[i]);
    if (!column) continue;
    if (contains(found, column->truth, &HeightColumn::truth))
      throw InputError(file, "has two columns of " + column->truth);
    found.push_back(*column);
  }
  if (!found.empty()) return found;
  throw InputError(
      file, "has no column of heights, such as height_mean_cm or height_m; its columns are {}",
      joined(table.columns, ", "));
}

bool is_missing(std::string_view text) { return text.empty() || text == "NA" || text == "."; }

std::map<std::string, double> heights_of(const CsvRow& row,
                                         const std::vector<HeightColumn>& columns) {
  std::map<std::string, double> heights_m;
  for (const HeightColumn& column : columns) {
    if (is_missing(row.text(column.column))) continue;
    const double height_m = row.number(column.column) / column.per_m;
    if (!is_plausible(height_m))
      row.fail(column.column, "is {:g} m; it must be {:g} to {:g} m", height_m, kLeastHeight_m,
               kMostHeight_m);
    heights_m[column.truth] = height_m;
  }
  return heights_m;
}

}  // namespace

MeasuredHeights read_measured_heights(const fs::path& file,
                                      const std::optional<std::string>& id_column) {
  const CsvTable table = read_csv_table(file);
  const std::size_t id =
      column_of(file, table, id_column ? std::vector{*id_column} : plot_id_properties(),
                "; --id names the column with the plots' ids");
  const std::vector<HeightColumn> columns = height_columns(file, table);
  MeasuredHeights measured{.file = file, .id_column = table.columns[id]};
  for (const CsvTable::Line& line : table.lines) {
    const std::vector<std::string_view> fields(line.fields.begin(), line.fields.end());
    const CsvRow row(file, line.line, table.columns, fields, table.commas);
    if (fields[id].empty()) row.fail(id, "is empty; every plot has an id");
    std::map<std::string, double> heights_m = heights_of(row, columns);
    if (heights_m.empty()) continue;
    const bool is_new =
        measured.plots_m.emplace(PlotId(line.fields[id]), std::move(heights_m)).second;
    if (!is_new)
      row.fail(id, "names plot {} again; a table has each plot once: give the mean of its plants",
               line.fields[id]);
  }
  if (measured.plots_m.empty()) throw InputError(file, "has no height");
  return measured;
}

std::vector<PlotId> not_found(const MeasuredHeights& measured, const Estimate& estimate) {
  std::set<PlotId> found;
  for (const PlotEstimate& plot : estimate.plots) found.insert(plot.id);
  std::vector<PlotId> missing;
  for (const auto& [id, heights_m] : measured.plots_m)
    if (!found.contains(id)) missing.push_back(id);
  if (missing.size() < measured.plots_m.size()) return missing;
  throw InputError(measured.file,
                   "has plot {} and others, and none of them is in the estimate; --plot-names, "
                   "--first-number or --boxes of estimator run give plots the field book's ids",
                   missing.front().text());
}

}  // namespace plotscan::estimate
