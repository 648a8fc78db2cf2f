// SPDX-License-Identifier: Apache-2.0
#include "farmbench/entry/internal/entered_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angle.h"
#include "core/contains.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/nearest_name.h"
#include "core/parse.h"
#include "core/place_json.h"
#include "core/plot_features.h"
#include "core/printable.h"
#include "core/text.h"
#include "estimate/height_properties.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

bool is_height_column(std::string name) {
  for (const std::string_view before : {estimate::kError, estimate::kLow, estimate::kHigh}) {
    if (name.starts_with(before)) name.erase(0, before.size());
  }
  return !estimate::height_of(name).empty();
}

const std::vector<std::string>& other_columns() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = {"plot_number", "row_number", "col_number",
                                    "points",      "confidence", "flags"};
    all.insert(all.end(), kBoxProperties.begin(), kBoxProperties.end());
    return all;
  }();
  return names;
}

void require_known_column(const std::string& column, const fs::path& file, Problems& problems) {
  if (is_height_column(column) || contains(other_columns(), column) ||
      contains(estimate::kBoxErrors, column))
    return;
  std::vector<std::string> names = other_columns();
  for (const char* height : {"mean", "max", "p50", "p90", "p95", "p99", "canopy_p95", "canopy_p99"})
    for (const std::string_view before : {std::string_view(), estimate::kLow, estimate::kHigh})
      names.push_back(estimate::property_of(height, before));
  const auto meant = nearest_name(column, names);
  problems.add(file.filename().string() + ":1", "there is no column \"" + column + "\"" +
                                                    (meant ? "; " + *meant + " may be meant" : ""));
}

// A table of ids alone measures nothing.
void require_content(const CsvTable& table, const fs::path& file, Problems& problems) {
  const auto says_something = [](const std::string& column) {
    return is_height_column(column) || contains(kBoxProperties, column);
  };
  if (!table.lines.empty() && std::ranges::none_of(table.columns, says_something))
    problems.add(file.filename().string() + ":1",
                 "no column is a height, such as height_mean_m, or of a box");
}

// "FOLDER/FILE:4: what is wrong" as a problem of FILE:4.
void add_error(const InputError& error, const fs::path& file, Problems& problems) {
  std::string what = error.what();
  if (what.starts_with(file.string())) what.erase(0, file.string().size());
  const std::size_t end = what.find(": ");
  if (end == std::string::npos) return problems.add(file.filename().string(), what);
  problems.add(file.filename().string() + what.substr(0, end), what.substr(end + 2));
}

// What R, NumPy and pandas write for a number that is not there.
bool is_absent(const std::string& cell) {
  return cell.empty() || cell == "NA" || cell == "NaN" || cell == "nan";
}

std::optional<double> number_of(const std::string& cell) {
  const auto value = parsed<double>(cell);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// Reasons with semicolons between them.
json entered_flags(const std::string& cell) {
  json flags = json::array();
  for (std::string flag : split(cell, ';')) {
    flag.erase(0, flag.find_first_not_of(' '));
    if (!flag.empty()) flags.push_back(flag);
  }
  return flags;
}

// "7" is the number 7, and so is "7.0", as tables have it in which some plot has no number.
json id_of(const std::string& cell) {
  const std::string digits = cell.ends_with(".0") ? cell.substr(0, cell.size() - 2) : cell;
  const bool is_number = !digits.empty() &&
                         digits.find_first_not_of("0123456789") == std::string::npos &&
                         digits.size() < 19 && (digits.size() == 1 || digits.front() != '0');
  return is_number ? json(std::stoull(digits)) : json(cell);
}

json cell_of(const std::string& column, const std::string& cell, const std::string& place,
             Problems& problems) {
  if (column == "flags") return entered_flags(cell);
  if (column == "plot_number") return id_of(cell);
  const std::optional<double> number = number_of(cell);
  if (!number) {
    problems.add(place, column + " is \"" + printable(cell) + "\"; it must be a number, or empty");
    return {};
  }
  return *number;
}

// The box of five columns: all of them, or none.
std::optional<PlotBox> box_of(const EnteredRow& row, Problems& problems) {
  const auto stated = std::ranges::count_if(
      kBoxProperties, [&](const char* name) { return row.properties.contains(name); });
  if (stated < static_cast<std::ptrdiff_t>(kBoxProperties.size())) {
    problems.add(row.place,
                 "a box is center_x_m, center_y_m, width_m, length_m and heading_deg, all five");
    return std::nullopt;
  }
  const auto value = [&row](const char* name) { return row.properties.at(name).get<double>(); };
  return PlotBox{.center = {value("center_x_m"), value("center_y_m")},
                 .width_m = value("width_m"),
                 .length_m = value("length_m"),
                 .heading_rad = value("heading_deg") * kDegrees};
}

EnteredRow row_of(const CsvTable& table, const CsvTable::Line& line, const fs::path& file,
                  Problems& problems) {
  EnteredRow row{.place = file.filename().string() + ":" + std::to_string(line.line)};
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& column = table.columns[i];
    const bool known = is_height_column(column) || contains(other_columns(), column);
    if (!known || is_absent(line.fields[i])) continue;
    json value = cell_of(column, line.fields[i], row.place, problems);
    if (!value.is_null()) row.properties[column] = std::move(value);
  }
  row.box_stated = std::ranges::any_of(
      kBoxProperties, [&](const char* name) { return row.properties.contains(name); });
  if (row.box_stated) row.box = box_of(row, problems);
  return row;
}

bool has_height(const json& properties) {
  for (const auto& [name, value] : properties.items())
    if (is_height_column(name)) return true;
  return false;
}

// Names that are not as documented would be ignored, as any other property is.
void require_content(const std::vector<EnteredRow>& rows, const std::string& name,
                     Problems& problems) {
  const auto says_something = [](const EnteredRow& row) {
    return row.box_stated || has_height(row.properties);
  };
  if (!rows.empty() && std::ranges::none_of(rows, says_something))
    problems.add(name, "no plot has a box or a height, a property such as height_mean_m");
}

// The box of one feature of a document, as any map of plots is read.
std::optional<PlotBox> box_of(const json& document, const json& feature, const EnteredRow& row,
                              Problems& problems) {
  json alone = document;
  alone["features"] = json::array({feature});
  try {
    return plot_features_of(alone, "", "").plots.front().box;
  } catch (const InputError& error) {
    std::string what = error.what();
    const std::size_t end = what.find(": feature 1");
    if (end != std::string::npos) what.erase(0, end + std::string(": feature 1").size());
    what.erase(0, what.find_first_not_of(": "));
    problems.add(row.place, what);
  }
  return std::nullopt;
}

}  // namespace

std::vector<EnteredRow> read_entered_table(const fs::path& file, Problems& problems) {
  std::vector<EnteredRow> rows;
  try {
    const CsvTable table = read_csv_table(file);
    for (const std::string& column : table.columns) require_known_column(column, file, problems);
    require_content(table, file, problems);
    for (const CsvTable::Line& line : table.lines)
      rows.push_back(row_of(table, line, file, problems));
  } catch (const InputError& error) {
    add_error(error, file, problems);
  }
  return rows;
}

std::vector<EnteredRow> read_entered_features(const fs::path& file, Problems& problems) {
  const std::string name = file.filename().string();
  std::vector<EnteredRow> rows;
  json document;
  try {
    document = read_json(file);
  } catch (const InputError& error) {
    add_error(error, file, problems);
    return rows;
  }
  if (!document.is_object() || !document.contains("features") || !document["features"].is_array()) {
    problems.add(name, "is no GeoJSON FeatureCollection");
    return rows;
  }
  const json features = std::exchange(document["features"], json::array());
  for (const json& feature : features) {
    EnteredRow row{.place = name + ": feature " + std::to_string(rows.size() + 1)};
    if (feature.is_object()) {
      if (feature.contains("properties") && feature["properties"].is_object())
        row.properties = feature["properties"];
      if (feature.contains("id") && !row.properties.contains("plot_number"))
        row.properties["plot_number"] = feature["id"];
      const auto flags = row.properties.find("flags");
      if (flags != row.properties.end() && flags->is_string())
        *flags = entered_flags(flags->get<std::string>());
      row.box_stated = feature.contains("geometry") && !feature["geometry"].is_null();
      if (row.box_stated) row.box = box_of(document, feature, row, problems);
    } else {
      problems.add(row.place, "is no feature");
    }
    rows.push_back(std::move(row));
  }
  require_content(rows, name, problems);
  return rows;
}

}  // namespace plotscan::farmbench
