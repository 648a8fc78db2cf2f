// SPDX-License-Identifier: Apache-2.0
#include "estimate/estimate.h"

#include <fstream>
#include <limits>
#include <numbers>
#include <set>

#include "core/csv.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/plot_features.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr double kDegrees = std::numbers::pi / 180;
constexpr std::string_view kPrefix = "height_";
constexpr std::string_view kSuffix = "_m";

std::string property_of(const std::string& height) {
  return std::string(kPrefix) + height + std::string(kSuffix);
}

// The name of a height from its property, "" when the property is no height.
std::string height_of(const std::string& property) {
  if (property.size() <= kPrefix.size() + kSuffix.size() || !property.starts_with(kPrefix) ||
      !property.ends_with(kSuffix)) {
    return "";
  }
  return property.substr(kPrefix.size(), property.size() - kPrefix.size() - kSuffix.size());
}

PlotFeature feature_of(const PlotEstimate& plot) {
  PlotFeature feature{.box = plot.box};
  feature.properties = {{"plot_number", plot.id}, {"points", plot.points}};
  if (plot.row > 0) feature.properties["row_number"] = plot.row;
  if (plot.column > 0) feature.properties["col_number"] = plot.column;
  for (const auto& [name, height_m] : plot.heights_m) {
    feature.properties[property_of(name)] = height_m;
  }
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

void write_heights(const fs::path& path, const std::vector<PlotEstimate>& plots) {
  std::set<std::string> names;
  for (const PlotEstimate& plot : plots) {
    for (const auto& [name, height_m] : plot.heights_m) names.insert(name);
  }
  std::ofstream out(path);
  out << "plot_number,row_number,col_number,center_x_m,center_y_m,width_m,length_m,heading_deg,"
         "points";
  for (const std::string& name : names) out << ',' << property_of(name);
  out << '\n';
  for (const PlotEstimate& plot : plots) {
    out << plot.id << ',' << plot.row << ',' << plot.column << ','
        << format_number(plot.box.center.x()) << ',' << format_number(plot.box.center.y()) << ','
        << format_number(plot.box.width_m) << ',' << format_number(plot.box.length_m) << ','
        << format_number(plot.box.heading_rad / kDegrees) << ',' << plot.points;
    for (const std::string& name : names) {
      const auto found = plot.heights_m.find(name);
      out << ',' << (found == plot.heights_m.end() ? "" : format_number(found->second));
    }
    out << '\n';
  }
  if (!out.flush()) throw InputError(path, "cannot be written");
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
  write_plot_features(folder / "plots.geojson", features);
  write_heights(folder / "heights.csv", estimate.plots);
}

Estimate read_estimate(const fs::path& path) {
  const bool is_folder = fs::is_directory(path);
  const fs::path file = is_folder ? path / "plots.geojson" : path;
  Estimate estimate{.method = is_folder ? method_of(path) : ""};
  bool any_height = false;
  for (const PlotFeature& feature : read_plot_features(file)) {
    estimate.plots.push_back(plot_of(feature, estimate.plots.size() + 1));
    any_height = any_height || !estimate.plots.back().heights_m.empty();
  }
  if (estimate.plots.empty()) throw InputError(file, "has no plots");
  if (!any_height) {
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
  return plot;
}

}  // namespace plotscan::estimate
