// SPDX-License-Identifier: Apache-2.0
#include "estimate/plot_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include <fmt/core.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/text.h"
#include "estimate/internal/overlaps.h"
#include "estimate/internal/table_columns.h"
#include "estimate/internal/vector_map.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;
namespace {

std::set<std::string> property_names(const std::vector<PlotFeature>& plots) {
  std::set<std::string> names;
  for (const PlotFeature& plot : plots) {
    for (const auto& [name, value] : plot.properties.items()) names.insert(name);
  }
  return names;
}

// The property in which at least one plot has an id.
std::optional<std::string> id_property_of(const fs::path& file,
                                          const std::vector<PlotFeature>& plots,
                                          const std::optional<std::string>& wanted) {
  const auto names_a_plot = [&](const std::string& property) {
    return std::ranges::any_of(
        plots, [&](const PlotFeature& plot) { return id_in(plot, property).has_value(); });
  };
  const std::set<std::string> names = property_names(plots);
  if (wanted) {
    if (names_a_plot(*wanted)) return wanted;
    throw InputError(file, "no plot has an id in a property \"{}\"; the plots' properties are: {}",
                     *wanted, joined({names.begin(), names.end()}, ", "));
  }
  for (const std::string& property : plot_id_properties()) {
    if (names_a_plot(property)) return property;
    for (const std::string& name : names)
      if (is_same_name(name, property) && names_a_plot(name)) return name;
  }
  return std::nullopt;
}

// "feature 3".
std::vector<std::string> feature_places(std::size_t plots) {
  std::vector<std::string> places;
  for (std::size_t i = 1; i <= plots; ++i) places.push_back("feature " + std::to_string(i));
  return places;
}

// `where` says of each plot where it stands in the file.
std::vector<PlotId> ids_of(const fs::path& file, const std::vector<PlotFeature>& plots,
                           const std::vector<std::string>& where, const std::string& property) {
  std::vector<PlotId> ids;
  std::map<PlotId, std::string> places;
  for (const PlotFeature& plot : plots) {
    const std::string& place = where[ids.size()];
    const std::optional<PlotId> id = id_in(plot, property);
    if (!id) {
      throw InputError(file,
                       "{} has no id in its property \"{}\", and others have; --id "
                       "names another property",
                       place, property);
    }
    const auto [earlier, is_new] = places.emplace(*id, place);
    if (!is_new) {
      throw InputError(file,
                       "{} and {} have the same {} \"{}\"; --id names a property that "
                       "differs from plot to plot",
                       earlier->second, place, property, id->text());
    }
    ids.push_back(*id);
  }
  return ids;
}

constexpr long long kMostPlaces = 1000000;  // rows, or columns, of a field

int place_of(const fs::path& file, const CsvTable& table, const CsvTable::Line& line,
             std::size_t column) {
  const std::vector<std::string_view> fields(line.fields.begin(), line.fields.end());
  return static_cast<int>(
      CsvRow(file, line.line, table.columns, fields, table.commas).integer(column, 1, kMostPlaces));
}

// What a table's column is called among the attributes of its plots. An estimate states the places
// of its plots under these two names.
std::string attribute_of(const std::string& column) {
  return column == "row_number" || column == "col_number" ? "given_" + column : column;
}

// "" where degrees have decimals enough.
std::string decimals_note(const std::optional<int>& few_decimals) {
  constexpr double kDegree_m = 111320;  // of latitude, and of longitude at the equator
  if (!few_decimals) return "";
  const double step_m = kDegree_m * std::pow(10, -*few_decimals);
  return fmt::format(
      "the map's degrees have {} decimals: corners of boxes are rounded to {:.2g} m; save it with "
      "8 "
      "decimals, or in the cloud's coordinates",
      *few_decimals, step_m);
}

// Plots are measured in cells of centimetres all over, so their area is what they cost.
void require_plot_size(const fs::path& file, const PlotMap& map) {
  for (std::size_t i = 0; i < map.plots.size(); ++i) {
    const PlotBox& box = map.plots[i].box;
    if (box.area_m2() <= kMostPlot_m2) continue;
    throw InputError(file,
                     "plot {} is {:.0f} x {:.0f} m; a plot has up to {:.0f} m2: "
                     "is this the field's outline?",
                     map.ids[i].text(), box.width_m, box.length_m, kMostPlot_m2);
  }
}

}  // namespace

NamedPlaces read_named_places(const fs::path& file, const std::optional<std::string>& id_property) {
  const CsvTable table = read_csv_table(file);
  const std::size_t row = column_of(file, table, {"row", "row_number"});
  const std::size_t column = column_of(file, table, {"column", "col", "col_number"});
  std::vector<PlotFeature> plots;
  std::vector<std::string> where;
  for (const CsvTable::Line& line : table.lines) {
    plots.emplace_back();
    where.push_back("line " + std::to_string(line.line));
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (i != row && i != column)
        plots.back().properties[attribute_of(table.columns[i])] = line.fields[i];
    }
  }
  if (plots.empty()) throw InputError(file, "has no plots");
  const auto property = id_property_of(file, plots, id_property);
  if (!property)
    throw InputError(file, "has no id of a plot; --id names the column, such as plot_id");
  const std::vector<PlotId> ids = ids_of(file, plots, where, *property);
  const auto attributes = is_of_estimate(plots) ? own_attributes : given_attributes;
  NamedPlaces named{.id_property = *property};
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const std::pair place{place_of(file, table, table.lines[i], row),
                          place_of(file, table, table.lines[i], column)};
    const bool is_new = named.plots.emplace(place, NamedPlot{ids[i], attributes(plots[i])}).second;
    if (!is_new)
      throw InputError(file, table.lines[i].line, "names a row and column that has a plot already");
  }
  return named;
}

PlotMap read_plot_map(const fs::path& place, const std::string& crs, double unit_m,
                      const std::optional<std::string>& id_property) {
  const fs::path file = estimated_map_of(place);
  PlacedPlots placed = is_vector_map(file)
                           ? plot_features_of(read_vector_map(file), file, crs, unit_m)
                           : read_plot_features(file, crs, unit_m);
  PlotMap map{.plots = std::move(placed.plots), .from_degrees = placed.from_degrees};
  if (map.plots.empty()) throw InputError(file, "has no plots");
  if (const auto property = id_property_of(file, map.plots, id_property)) {
    map.id_property = *property;
    map.ids = ids_of(file, map.plots, feature_places(map.plots.size()), *property);
  } else {
    for (std::size_t i = 0; i < map.plots.size(); ++i) map.ids.emplace_back(i + 1);
  }
  require_plot_size(file, map);
  for (const std::string& note : {decimals_note(placed.few_decimals),
                                  overlap_note(list_of(map.plots, &PlotFeature::box), map.ids)})
    if (!note.empty()) map.notes.push_back(note);
  return map;
}

void take_names(const PlotMap& map, Estimate& estimate) {
  check(map.plots.size() == estimate.plots.size(), "an estimate of other plots than the map's");
  estimate.id_property = map.id_property;
  const auto attributes = is_of_estimate(map.plots) ? own_attributes : given_attributes;
  for (std::size_t i = 0; i < map.plots.size(); ++i) {
    const PlotEstimate named = plot_of(map.plots[i], i + 1);
    estimate.plots[i].id = map.ids[i];
    estimate.plots[i].trial = named.trial;
    estimate.plots[i].row = named.row;
    estimate.plots[i].column = named.column;
    estimate.plots[i].attributes = attributes(map.plots[i]);
  }
  if (!map.notes.empty()) {
    if (!estimate.diagnostics.notes) estimate.diagnostics.notes.emplace();
    std::ranges::copy(map.notes, std::back_inserter(*estimate.diagnostics.notes));
  }
  estimate.diagnostics.boxes = {
      .plots = map.plots.size(), .id_property = map.id_property, .from_degrees = map.from_degrees};
}

}  // namespace plotscan::estimate
