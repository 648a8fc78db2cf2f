// SPDX-License-Identifier: Apache-2.0
#include "estimate/plot_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "core/angle.h"
#include "core/csv.h"
#include "core/list_of.h"
#include "core/text.h"
#include "core/text_file.h"
#include "estimate/height_properties.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

// A table's column: its name and what stands in it for a plot.
struct Column {
  std::string name;
  std::function<std::string(const PlotEstimate&)> text;
};

// The heights of any of the plots, each followed by its standard error and interval.
void add_heights(const std::vector<PlotEstimate>& plots, std::vector<Column>& columns) {
  std::set<std::string> names;
  std::set<std::string> with_errors;
  for (const PlotEstimate& plot : plots) {
    for (const auto& [name, height_m] : plot.heights_m) names.insert(name);
    for (const auto& [name, error] : plot.errors) with_errors.insert(name);
  }
  for (const std::string& name : names) {
    columns.push_back({property_of(name), [name](const PlotEstimate& plot) {
                         const auto found = plot.heights_m.find(name);
                         return found == plot.heights_m.end() ? "" : format_number(found->second);
                       }});
    if (!with_errors.contains(name)) continue;
    for (const auto& [before, value] : kErrorProperties) {
      columns.push_back(
          {property_of(name, before), [name, value = value](const PlotEstimate& plot) {
             const auto found = plot.errors.find(name);
             return found == plot.errors.end() ? "" : format_number(found->second.*value);
           }});
    }
  }
}

// A value as a field of a table: texts as they are, nothing for null and NaN, else as JSON.
std::string field_of(const json& value) {
  const bool is_nan = value.is_number_float() && std::isnan(value.get<double>());
  if (value.is_null() || is_nan) return "";
  return csv_field(value.is_string() ? value.get<std::string>() : value.dump());
}

// An attribute of a plot, or `otherwise` where it has none of that name.
std::string attribute(const PlotEstimate& plot, const std::string& name,
                      const std::string& otherwise = "") {
  const auto found = plot.attributes.find(name);
  return found == plot.attributes.end() ? otherwise : field_of(*found);
}

Column attribute_column(const std::string& name) {
  return {name, [name](const PlotEstimate& plot) { return attribute(plot, name); }};
}

Column id_column(const std::string& name) {
  return {name, [](const PlotEstimate& plot) { return csv_field(plot.id.text()); }};
}

// The attributes of any of the plots that no other column shows.
void add_attributes(const std::vector<PlotEstimate>& plots, std::vector<Column>& columns) {
  std::set<std::string> names;
  for (const PlotEstimate& plot : plots) {
    for (const auto& [name, value] : plot.attributes.items()) names.insert(name);
  }
  for (const Column& column : columns) names.erase(column.name);
  for (const std::string& name : names) columns.push_back(attribute_column(name));
}

// The flags' reasons have neither quotes nor line ends.
std::string quoted(const std::vector<std::string>& flags) {
  return flags.empty() ? "" : '"' + joined(flags, "; ") + '"';
}

Column flags_column() {
  return {"flags", [](const PlotEstimate& plot) { return quoted(plot.flags); }};
}

// The place in the grid, as given or found; empty where there is none. The trial only where there
// are several.
void add_place(const std::vector<PlotEstimate>& plots, std::vector<Column>& columns) {
  const auto text = [](int place) { return place > 0 ? std::to_string(place) : ""; };
  if (std::ranges::any_of(plots, [](const auto& plot) { return plot.trial > 0; }))
    columns.push_back({"trial_number", [text](const auto& plot) { return text(plot.trial); }});
  columns.push_back({"row_number", [text](const auto& plot) {
                       return attribute(plot, "row_number", text(plot.row));
                     }});
  columns.push_back({"col_number", [text](const auto& plot) {
                       return attribute(plot, "col_number", text(plot.column));
                     }});
}

// The boxes' standard errors, where any plot has them.
void add_box_errors(const std::vector<PlotEstimate>& plots, std::vector<Column>& columns) {
  if (std::ranges::none_of(plots, [](const auto& plot) { return plot.box_error.has_value(); }))
    return;
  for (std::size_t i = 0; i < kBoxErrors.size(); ++i) {
    columns.push_back({kBoxErrors[i], [i](const PlotEstimate& plot) {
                         return plot.box_error ? format_number(numbers_of(*plot.box_error)[i]) : "";
                       }});
  }
}

std::vector<Column> columns_of(const Estimate& estimate) {
  const std::vector<PlotEstimate>& plots = estimate.plots;
  std::vector<Column> columns = {id_column(estimate.id_property)};
  add_place(plots, columns);
  const std::vector<Column> box = {
      {"center_x_m", [](const auto& plot) { return format_number(plot.box.center.x()); }},
      {"center_y_m", [](const auto& plot) { return format_number(plot.box.center.y()); }},
      {"width_m", [](const auto& plot) { return format_number(plot.box.width_m); }},
      {"length_m", [](const auto& plot) { return format_number(plot.box.length_m); }},
      {"heading_deg",
       [](const auto& plot) { return format_number(plot.box.heading_rad / kDegrees); }},
      {"points", [](const auto& plot) { return std::to_string(plot.points); }}};
  columns.insert(columns.end(), box.begin(), box.end());
  add_heights(plots, columns);
  add_box_errors(plots, columns);
  if (std::ranges::any_of(plots, [](const auto& plot) { return plot.confidence.has_value(); })) {
    columns.push_back({"confidence", [](const auto& plot) {
                         return plot.confidence ? format_number(*plot.confidence) : "";
                       }});
  }
  columns.push_back(flags_column());
  add_attributes(plots, columns);
  return columns;
}

// The columns for a database: the plots' names, their known attributes, their measured heights.
std::vector<Column> trait_columns(const std::vector<PlotEstimate>& plots) {
  const std::string unit = "observationunit_name";
  std::vector<Column> columns = {id_column(unit)};
  add_place(plots, columns);
  add_attributes(plots, columns);
  // An attribute of the first column's name, where the ids are another one.
  if (std::ranges::any_of(plots, [&](const auto& plot) {
        const std::string id = csv_field(plot.id.text());
        return attribute(plot, unit, id) != id;
      }))
    columns.push_back(
        {"given_" + unit, [unit](const auto& plot) { return attribute(plot, unit); }});
  add_heights(plots, columns);
  columns.push_back(flags_column());
  return columns;
}

void write_table(const fs::path& path, const std::vector<Column>& columns,
                 const std::vector<PlotEstimate>& plots) {
  const auto line_of = [&](const auto& field) {
    return fmt::format("{}\n", fmt::join(list_of(columns, field), ","));
  };
  TextFile out(path);
  out << line_of([](const Column& column) { return csv_field(column.name); });
  for (const PlotEstimate& plot : plots)
    out << line_of([&](const Column& column) { return column.text(plot); });
  out.close();
}

}  // namespace

void write_heights(const fs::path& path, const Estimate& estimate) {
  write_table(path, columns_of(estimate), estimate.plots);
}

void write_traits(const fs::path& path, const Estimate& estimate) {
  write_table(path, trait_columns(estimate.plots), estimate.plots);
}

void write_dated(const fs::path& path, const std::vector<DatedPlot>& plots) {
  std::vector<PlotEstimate> lines;
  for (const auto& [date, plot] : plots) {
    lines.push_back(plot);
    lines.back().attributes["date"] = date;
  }
  std::vector<Column> columns = {id_column("plot_id"), attribute_column("date")};
  add_place(lines, columns);
  add_heights(lines, columns);
  columns.push_back(flags_column());
  write_table(path, columns, lines);
}

void write_numbers(const fs::path& path, std::vector<PlotEstimate> plots,
                   const std::vector<NumberColumn>& numbers) {
  std::vector<Column> columns = {id_column("plot_id")};
  add_place(plots, columns);
  for (const NumberColumn& number : numbers) {
    columns.push_back(attribute_column(number.name));
    for (std::size_t i = 0; i < plots.size(); ++i)
      plots[i].attributes[number.name] = number.values[i];
  }
  add_attributes(plots, columns);
  write_table(path, columns, plots);
}

}  // namespace plotscan::estimate
