// SPDX-License-Identifier: Apache-2.0
#include "estimate/estimate.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <set>

#include "core/csv.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/plot_features.h"
#include "core/text.h"
#include "estimate/ground_grids.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr double kDegrees = std::numbers::pi / 180;
constexpr std::string_view kPrefix = "height_";
constexpr const char* kError = "se_";
constexpr const char* kLow = "low95_";
constexpr const char* kHigh = "high95_";
constexpr std::string_view kCanopy = "canopy_";
constexpr std::string_view kSuffix = "_m";

// The property of a height, and of what belongs to it ("se_", "low95_", "high95_"): the truth's own
// names, height_p95_m and canopy_p95_m.
std::string property_of(const std::string& height, const char* before = "") {
  const std::string prefix = height.starts_with(kCanopy) ? "" : std::string(kPrefix);
  return before + prefix + height + std::string(kSuffix);
}

// The name of a height from its property, "" when the property is no height.
std::string height_of(const std::string& property) {
  if (!property.ends_with(kSuffix)) return "";
  const std::string name = property.substr(0, property.size() - kSuffix.size());
  if (name.size() > kCanopy.size() && name.starts_with(kCanopy)) return name;
  if (name.size() <= kPrefix.size() || !name.starts_with(kPrefix)) return "";
  return name.substr(kPrefix.size());
}

PlotFeature feature_of(const PlotEstimate& plot) {
  PlotFeature feature{.box = plot.box};
  feature.properties = {{"plot_number", plot.id}, {"points", plot.points}};
  if (plot.row > 0) feature.properties["row_number"] = plot.row;
  if (plot.column > 0) feature.properties["col_number"] = plot.column;
  for (const auto& [name, height_m] : plot.heights_m) {
    feature.properties[property_of(name)] = height_m;
  }
  for (const auto& [name, error] : plot.errors) {
    feature.properties[property_of(name, kError)] = error.standard_error_m;
    feature.properties[property_of(name, kLow)] = error.low95_m;
    feature.properties[property_of(name, kHigh)] = error.high95_m;
  }
  if (plot.confidence) feature.properties["confidence"] = *plot.confidence;
  if (!plot.flags.empty()) feature.properties["flags"] = plot.flags;
  return feature;
}

// A whole number in a property, or `otherwise` where there is none.
template <class Integer>
Integer integer_of(const json& properties, const char* name, Integer otherwise) {
  const auto found = properties.find(name);
  if (found == properties.end() || !found->is_number_integer()) return otherwise;
  const auto value = found->get<std::int64_t>();
  const bool in_range =
      value >= 0 && static_cast<std::uint64_t>(value) <= std::numeric_limits<Integer>::max();
  return in_range ? static_cast<Integer>(value) : otherwise;
}

// A table's column: its name and what stands in it for a plot.
struct Column {
  std::string name;
  std::function<std::string(const PlotEstimate&)> text;
};

template <class Value>
std::string text_of(const std::map<std::string, Value>& values, const std::string& name,
                    double (*number)(const Value&)) {
  const auto found = values.find(name);
  return found == values.end() ? "" : format_number(number(found->second));
}

// The heights of any of the plots, each followed by its standard error and interval.
void add_heights(const std::vector<PlotEstimate>& plots, std::vector<Column>& columns) {
  std::set<std::string> names;
  std::set<std::string> with_errors;
  for (const PlotEstimate& plot : plots) {
    for (const auto& [name, height_m] : plot.heights_m) names.insert(name);
    for (const auto& [name, error] : plot.errors) with_errors.insert(name);
  }
  using Number = double (*)(const HeightError&);
  const std::vector<std::pair<const char*, Number>> parts = {
      {kError, [](const HeightError& error) { return error.standard_error_m; }},
      {kLow, [](const HeightError& error) { return error.low95_m; }},
      {kHigh, [](const HeightError& error) { return error.high95_m; }}};
  for (const std::string& name : names) {
    columns.push_back({property_of(name), [name](const PlotEstimate& plot) {
                         return text_of<double>(plot.heights_m, name,
                                                [](const double& height_m) { return height_m; });
                       }});
    if (!with_errors.contains(name)) continue;
    for (const auto& [before, number] : parts) {
      columns.push_back({property_of(name, before), [name, number](const PlotEstimate& plot) {
                           return text_of<HeightError>(plot.errors, name, number);
                         }});
    }
  }
}

// The flags' reasons have neither quotes nor line ends.
std::string quoted(const std::vector<std::string>& flags) {
  return flags.empty() ? "" : '"' + joined(flags, "; ") + '"';
}

std::vector<Column> columns_of(const std::vector<PlotEstimate>& plots) {
  std::vector<Column> columns = {
      {"plot_number", [](const auto& plot) { return std::to_string(plot.id); }},
      {"row_number", [](const auto& plot) { return std::to_string(plot.row); }},
      {"col_number", [](const auto& plot) { return std::to_string(plot.column); }},
      {"center_x_m", [](const auto& plot) { return format_number(plot.box.center.x()); }},
      {"center_y_m", [](const auto& plot) { return format_number(plot.box.center.y()); }},
      {"width_m", [](const auto& plot) { return format_number(plot.box.width_m); }},
      {"length_m", [](const auto& plot) { return format_number(plot.box.length_m); }},
      {"heading_deg",
       [](const auto& plot) { return format_number(plot.box.heading_rad / kDegrees); }},
      {"points", [](const auto& plot) { return std::to_string(plot.points); }}};
  add_heights(plots, columns);
  if (std::ranges::any_of(plots, [](const auto& plot) { return plot.confidence.has_value(); })) {
    columns.push_back({"confidence", [](const auto& plot) {
                         return plot.confidence ? format_number(*plot.confidence) : "";
                       }});
    columns.push_back({"flags", [](const auto& plot) { return quoted(plot.flags); }});
  }
  return columns;
}

void write_heights(const fs::path& path, const std::vector<PlotEstimate>& plots) {
  const std::vector<Column> columns = columns_of(plots);
  std::ofstream out(path);
  for (const Column& column : columns)
    out << (&column == &columns.front() ? "" : ",") << column.name;
  out << '\n';
  for (const PlotEstimate& plot : plots) {
    for (const Column& column : columns) {
      out << (&column == &columns.front() ? "" : ",") << column.text(plot);
    }
    out << '\n';
  }
  if (!out.flush()) throw InputError(path, "cannot be written");
}

// The standard errors and intervals that stand beside the heights.
std::map<std::string, HeightError> errors_of(const json& properties,
                                             const std::map<std::string, double>& heights_m) {
  std::map<std::string, HeightError> errors;
  for (const auto& [name, height_m] : heights_m) {
    const auto number = [&](const char* before) {
      const auto found = properties.find(property_of(name, before));
      return found != properties.end() && found->is_number() ? found->get<double>() : std::nan("");
    };
    const HeightError error{number(kError), number(kLow), number(kHigh)};
    if (std::isfinite(error.low95_m) && std::isfinite(error.high95_m)) errors[name] = error;
  }
  return errors;
}

std::vector<std::string> flags_of(const json& properties) {
  std::vector<std::string> flags;
  const auto found = properties.find("flags");
  if (found == properties.end() || !found->is_array()) return flags;
  for (const json& flag : *found) {
    if (flag.is_string()) flags.push_back(flag.get<std::string>());
  }
  return flags;
}

// The method named by the folder's manifest, "" where there is none.
std::string method_of(const fs::path& folder) {
  if (!fs::exists(folder / "manifest.json")) return "";
  const json options = read_manifest(folder).value("options", json::object());
  const bool named =
      options.is_object() && options.contains("method") && options["method"].is_string();
  return named ? options["method"].get<std::string>() : "";
}

}  // namespace

void write_estimate(const fs::path& folder, const Estimate& estimate) {
  std::vector<PlotFeature> features;
  for (const PlotEstimate& plot : estimate.plots) features.push_back(feature_of(plot));
  write_plot_features(folder / "plots.geojson", features, estimate.crs, estimate.units);
  write_heights(folder / "heights.csv", estimate.plots);
  if (estimate.ground)
    write_ground(folder, *estimate.ground, estimate.units.value_or(CoordinateUnits{}));
}

Estimate read_estimate(const fs::path& path) {
  const bool is_folder = fs::is_directory(path);
  const fs::path file = is_folder ? path / "plots.geojson" : path;
  Estimate estimate{.method = is_folder ? method_of(path) : ""};
  estimate.units = read_coordinate_units(file);
  bool any_height = false;
  for (const PlotFeature& feature : read_plot_features(file)) {
    estimate.plots.push_back(plot_of(feature, estimate.plots.size() + 1));
    any_height = any_height || !estimate.plots.back().heights_m.empty();
  }
  if (estimate.plots.empty() && estimate.method.empty()) throw InputError(file, "has no plots");
  if (!any_height && !estimate.plots.empty()) {
    throw InputError(file,
                     "no plot has a height; a height is a number in a property "
                     "height_<name>_m, such as height_raw-p99_m");
  }
  return estimate;
}

PlotEstimate plot_of(const PlotFeature& feature, std::size_t number) {
  PlotEstimate plot{
      .id = integer_of(feature.properties, "plot_number", static_cast<std::uint32_t>(number)),
      .row = integer_of(feature.properties, "row_number", 0),
      .column = integer_of(feature.properties, "col_number", 0),
      .box = feature.box,
      .points = integer_of(feature.properties, "points", std::size_t{0})};
  for (const auto& [property, value] : feature.properties.items()) {
    const std::string name = height_of(property);
    if (!name.empty() && value.is_number()) plot.heights_m[name] = value.get<double>();
  }
  plot.errors = errors_of(feature.properties, plot.heights_m);
  plot.flags = flags_of(feature.properties);
  const auto confidence = feature.properties.find("confidence");
  if (confidence != feature.properties.end() && confidence->is_number())
    plot.confidence = confidence->get<double>();
  return plot;
}

}  // namespace plotscan::estimate
