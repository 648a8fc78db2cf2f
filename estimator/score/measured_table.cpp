// SPDX-License-Identifier: Apache-2.0
#include "score/measured_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "core/coordinate_units.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/plot_features.h"
#include "core/text.h"
#include "estimate/height_properties.h"

namespace plotscan::score {
namespace fs = std::filesystem;
namespace {

constexpr std::array<const char*, 3> kRulers = {"mm", "cm", "m"};  // units of heights
constexpr const char* kUnnamed = "height_hand_m";                  // what "height_cm" is called

// A column of heights: the truth that it states, and how many of its units a metre has.
struct HeightColumn {
  std::size_t column;
  std::string truth;
  double per_m;
};

using MeasuredById = std::map<PlotId, std::map<std::string, double>>;

std::optional<HeightColumn> height_column(std::size_t column, const std::string& name) {
  for (const std::string unit : kRulers) {
    if (!name.ends_with("_" + unit)) continue;
    const std::string stem = name.substr(0, name.size() - unit.size() - 1);
    std::string truth = stem == "height" ? kUnnamed : stem + std::string(estimate::kSuffix);
    if (estimate::height_of(truth).empty()) return std::nullopt;
    return HeightColumn{column, std::move(truth), std::round(1 / unit_named(unit).value())};
  }
  return std::nullopt;
}

std::vector<HeightColumn> height_columns(const fs::path& file, const CsvTable& table) {
  std::vector<HeightColumn> found;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::optional<HeightColumn> column = height_column(i, table.columns[i]);
    if (!column) continue;
    if (std::ranges::find(found, column->truth, &HeightColumn::truth) != found.end())
      throw InputError(file, "has two columns of " + column->truth);
    found.push_back(*column);
  }
  if (!found.empty()) return found;
  throw InputError(file,
                   "has no column of heights, such as height_mean_cm or height_m; its "
                   "columns are " +
                       joined(table.columns, ", "));
}

std::size_t id_column_of(const fs::path& file, const CsvTable& table,
                         const std::optional<std::string>& wanted) {
  const std::vector<std::string> names =
      wanted ? std::vector<std::string>{*wanted} : plot_id_properties();
  for (const std::string& name : names) {
    const auto found = std::ranges::find(table.columns, name);
    if (found != table.columns.end())
      return static_cast<std::size_t>(found - table.columns.begin());
  }
  throw InputError(file, "has no column " + joined(names, " or ") +
                             "; --id names the column with the plots' ids; its columns are " +
                             joined(table.columns, ", "));
}

bool is_missing(std::string_view text) { return text.empty() || text == "NA" || text == "."; }

std::map<std::string, double> heights_of(const CsvRow& row,
                                         const std::vector<HeightColumn>& columns) {
  std::map<std::string, double> heights_m;
  for (const HeightColumn& column : columns) {
    if (is_missing(row.text(column.column))) continue;
    const double height_m = row.number(column.column) / column.per_m;
    if (!estimate::is_plausible(height_m))
      row.fail(column.column, fmt::format("is {:g} m; it must be {:g} to {:g} m", height_m,
                                          estimate::kLeastHeight_m, estimate::kMostHeight_m));
    heights_m[column.truth] = height_m;
  }
  return heights_m;
}

MeasuredById measured_by_id(const fs::path& file, const CsvTable& table, std::size_t id_column) {
  const std::vector<HeightColumn> columns = height_columns(file, table);
  MeasuredById measured;
  for (const CsvTable::Line& line : table.lines) {
    const std::vector<std::string_view> fields(line.fields.begin(), line.fields.end());
    const CsvRow row(file, line.line, table.columns, fields);
    if (fields[id_column].empty()) row.fail(id_column, "is empty; every plot has an id");
    std::map<std::string, double> heights_m = heights_of(row, columns);
    if (heights_m.empty()) continue;
    const bool is_new =
        measured.emplace(PlotId(line.fields[id_column]), std::move(heights_m)).second;
    if (!is_new)
      row.fail(id_column, "names plot " + line.fields[id_column] +
                              " again; a table has each plot once: give the mean of its plants");
  }
  if (measured.empty()) throw InputError(file, "has no height");
  return measured;
}

}  // namespace

bool is_measured_table(const fs::path& truth) {
  constexpr std::array<const char*, 3> kTables = {".csv", ".tsv", ".txt"};
  return !fs::is_directory(truth) && std::ranges::find(kTables, truth.extension()) != kTables.end();
}

MeasuredPlots read_measured(const fs::path& file, const estimate::Estimate& estimate,
                            const std::optional<std::string>& id_column) {
  const CsvTable table = read_csv_table(file);
  const std::size_t column = id_column_of(file, table, id_column);
  MeasuredById measured = measured_by_id(file, table, column);
  MeasuredPlots truth{.id_column = table.columns[column]};
  bool any = false;
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    auto heights_m = measured.extract(plot.id);
    any = any || !heights_m.empty();
    truth.plots.push_back({.id = plot.id,
                           .trial = plot.trial,
                           .row = plot.row,
                           .column = plot.column,
                           .box = plot.box,
                           .scored = !heights_m.empty()});
    if (!heights_m.empty()) truth.plots.back().heights_m = std::move(heights_m.mapped());
  }
  for (const auto& [id, heights_m] : measured) truth.not_found.push_back(id);
  if (any) return truth;
  throw InputError(file, "has plot " + truth.not_found.front().text() +
                             " and others, and none of them is in the estimate; --plot-names, "
                             "--first-number or --boxes of estimator run give plots the field "
                             "book's ids");
}

}  // namespace plotscan::score
