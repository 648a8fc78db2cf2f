// SPDX-License-Identifier: Apache-2.0
#include "estimate/estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "core/angle.h"
#include "core/contains.h"
#include "core/error.h"
#include "core/geodesy.h"
#include "core/list_of.h"
#include "core/manifest.h"
#include "core/place_json.h"
#include "core/stated_system.h"
#include "core/statistics.h"
#include "estimate/ground_grids.h"
#include "estimate/height_properties.h"
#include "estimate/plot_tables.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

// Properties of a plane of ground (PlotGround): z, the slopes east and north, the tolerance.
constexpr std::array<const char*, 4> kPlane = {"ground_z_m", "ground_slope_x", "ground_slope_y",
                                               "ground_tolerance_m"};

// Whether a property is one of those that an estimate gives its plots.
bool is_measured(std::string property) {
  if (property == "points" || property == "confidence" || property == "flags") return true;
  if (contains(kPlane, property)) return true;
  if (contains(kBoxErrors, property)) return true;
  for (const auto& [before, value] : kErrorProperties) {
    if (property.starts_with(before)) property.erase(0, before.size());
  }
  return !height_of(property).empty();
}

// What stands before a map's property of a name that an estimate gives its plots.
constexpr std::string_view kGiven = "given_";

// The same of a map that has been through an estimate already, and through one of that.
bool was_given(std::string property) {
  if (!property.starts_with(kGiven)) return false;
  while (property.starts_with(kGiven)) property.erase(0, kGiven.size());
  return is_measured(property);
}

// Whether a height has its standard error beside it.
bool has_error_of_height(const json& properties) {
  for (const auto& [property, value] : properties.items()) {
    if (!height_of(property).empty() && properties.contains(std::string(kError) + property))
      return true;
  }
  return false;
}

// Adds numbers as properties of these names.
template <std::size_t Count>
void add_numbers(const std::array<const char*, Count>& names,
                 const std::array<double, Count>& values, json& properties) {
  for (std::size_t i = 0; i < Count; ++i) properties[names[i]] = values[i];
}

PlotFeature feature_of(const PlotEstimate& plot, const std::string& id_property) {
  PlotFeature feature{.box = plot.box, .properties = plot.attributes, .id = plot.id};
  if (!feature.properties.contains(id_property)) feature.properties[id_property] = plot.id;
  feature.properties["points"] = plot.points;
  if (plot.box_error) add_numbers(kBoxErrors, numbers_of(*plot.box_error), feature.properties);
  if (plot.trial > 0) feature.properties["trial_number"] = plot.trial;
  if (plot.row > 0) feature.properties["row_number"] = plot.row;
  if (plot.column > 0) feature.properties["col_number"] = plot.column;
  for (const auto& [name, height_m] : plot.heights_m) {
    feature.properties[property_of(name)] = height_m;
  }
  for (const auto& [name, error] : plot.errors) {
    for (const auto& [before, value] : kErrorProperties)
      feature.properties[property_of(name, before)] = error.*value;
  }
  if (plot.confidence) feature.properties["confidence"] = *plot.confidence;
  if (!plot.flags.empty()) feature.properties["flags"] = plot.flags;
  if (const auto& ground = plot.ground)
    add_numbers(kPlane, {ground->z_m, ground->slope.x(), ground->slope.y(), ground->tolerance_m},
                feature.properties);
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

// The feature's own id, else its plot_number, else the number.
PlotId id_of(const PlotFeature& feature, std::size_t number) {
  if (feature.id) return *feature.id;
  const auto found = feature.properties.find("plot_number");
  if (found == feature.properties.end()) return number;
  return PlotId::from(*found).value_or(number);
}

// NaN where there is none.
double number_in(const json& properties, const std::string& name) {
  const auto found = properties.find(name);
  return found != properties.end() && found->is_number() ? found->get<double>() : kNaN;
}

// The standard errors and intervals that stand beside the heights.
std::map<std::string, HeightError> errors_of(const json& properties,
                                             const std::map<std::string, double>& heights_m) {
  std::map<std::string, HeightError> errors;
  for (const auto& [name, height_m] : heights_m) {
    HeightError error;
    for (const auto& [before, value] : kErrorProperties)
      error.*value = number_in(properties, property_of(name, before));
    if (std::isfinite(error.low95_m) && std::isfinite(error.high95_m)) errors[name] = error;
  }
  return errors;
}

// Numbers in properties; none where one of them lacks.
template <std::size_t Count>
std::optional<std::array<double, Count>> numbers_in(const json& properties,
                                                    const std::array<const char*, Count>& names) {
  std::array<double, Count> values = {};
  for (std::size_t i = 0; i < Count; ++i) {
    values[i] = number_in(properties, names[i]);
    if (std::isnan(values[i])) return std::nullopt;
  }
  return values;
}

std::optional<PlotGround> ground_of(const json& properties) {
  const auto values = numbers_in(properties, kPlane);
  if (!values) return std::nullopt;
  const auto& [z_m, slope_x, slope_y, tolerance_m] = *values;
  return PlotGround{.z_m = z_m, .slope = {slope_x, slope_y}, .tolerance_m = tolerance_m};
}

std::optional<PlotBoxError> box_error_of(const json& properties) {
  const auto values = numbers_in(properties, kBoxErrors);
  if (!values) return std::nullopt;
  const auto& [along_m, across_m, width_m, length_m, heading_deg] = *values;
  return PlotBoxError{along_m, across_m, width_m, length_m, heading_deg * kDegrees};
}

std::vector<std::string> stated_flags(const json& properties) {
  std::vector<std::string> flags;
  const auto found = properties.find("flags");
  if (found == properties.end() || !found->is_array()) return flags;
  for (const json& flag : *found) {
    if (flag.is_string()) flags.push_back(flag.get<std::string>());
  }
  return flags;
}

void require_plausible(const PlotEstimate& plot, const fs::path& file) {
  for (const auto& [name, height_m] : plot.heights_m) {
    if (!is_plausible(height_m))
      throw InputError(file, "plot {}: {} is {:g}; it must be metres, {:g} to {:g}", plot.id.text(),
                       property_of(name), height_m, kLeastHeight_m, kMostHeight_m);
  }
}

// The text at that place of the document; "" where there is none.
std::string text_at(const json& document, const json::json_pointer& place) {
  const bool is_text = document.contains(place) && document[place].is_string();
  return is_text ? document[place].get<std::string>() : "";
}

// Reads from the folder's manifest, if there is one, what made the estimate.
void read_made_by(const fs::path& folder, Estimate& estimate) {
  if (!fs::exists(folder / "manifest.json")) return;
  const json manifest = read_manifest(folder);
  estimate.method = text_at(manifest, json::json_pointer("/options/method"));
  estimate.diagnostics.why_no_plots =
      text_at(manifest, json::json_pointer("/results/diagnostics") / kWhyNoPlots);
}

}  // namespace

bool is_of_estimate(const std::vector<PlotFeature>& features) {
  return std::ranges::any_of(features, [](const PlotFeature& feature) {
    const json& properties = feature.properties;
    const bool has_box = std::ranges::all_of(
        kBoxProperties, [&](const char* name) { return properties.contains(name); });
    return has_box && properties.contains("points") &&
           (properties.contains(kPlane[0]) || has_error_of_height(properties));
  });
}

json own_attributes(const PlotFeature& feature) {
  json attributes = json::object();
  for (const auto& [property, value] : feature.properties.items()) {
    if (!is_measured(property) && !was_given(property) && !is_box_property(property))
      attributes[property] = value;
  }
  return attributes;
}

json given_attributes(const PlotFeature& feature) {
  json attributes = json::object();
  for (const auto& [property, value] : feature.properties.items()) {
    if (!is_measured(property) && !is_box_property(property)) attributes[property] = value;
  }
  for (const auto& [property, value] : feature.properties.items()) {
    if (!is_measured(property)) continue;
    std::string name = std::string(kGiven) + property;
    while (attributes.contains(name)) name.insert(0, kGiven);
    attributes[name] = value;
  }
  return attributes;
}

std::vector<PlotFeature> features_of(const Estimate& estimate) {
  return list_of(estimate.plots,
                 [&](const PlotEstimate& plot) { return feature_of(plot, estimate.id_property); });
}

void write_estimate(const fs::path& folder, const Estimate& estimate) {
  const std::vector<PlotFeature> features = features_of(estimate);
  const CoordinateUnits units = estimate.units.value_or(CoordinateUnits{});
  write_plot_features(folder / "plots.geojson", features, estimate.crs, estimate.units);
  const std::optional<UtmSystem> utm = utm_system(estimate.crs);
  if (utm && units.horizontal_m == 1) {
    write_plot_features_wgs84(
        folder / "plots.wgs84.geojson", features,
        [&](const Eigen::Vector2d& corner) -> Eigen::Vector2d {
          const GeodeticPoint point = geodetic_from_utm(utm->zone, {corner.x(), corner.y(), 0});
          return {point.longitude_deg, point.latitude_deg};
        });
  }
  write_heights(folder / "heights.csv", estimate);
  if (estimate.ground) write_ground(folder, *estimate.ground, units, estimate.crs);
  if (!estimate.canopy_m.empty())
    write_canopy(folder, *estimate.ground, estimate.canopy_m, units, estimate.crs);
  if (estimate.clusters.empty()) return;
  const auto feature = [](const PlotBox& box) { return PlotFeature{.box = box}; };
  write_plot_features(folder / "clusters.geojson", list_of(estimate.clusters, feature),
                      estimate.crs, estimate.units);
}

Estimate read_estimate(const fs::path& path, const std::string& crs) {
  const bool is_folder = fs::is_directory(path);
  const fs::path file = estimated_map_of(path);
  Estimate estimate;
  if (is_folder) read_made_by(path, estimate);
  const nlohmann::json document = read_map_document(file);
  const PlacedPlots placed = plot_features_of(document, file, crs);
  estimate.crs = placed.from_degrees ? crs : stated_system(document).crs;
  estimate.units = placed.units;
  estimate.plots = plots_of(placed.plots, file);
  if (is_folder && fs::exists(path / "clusters.geojson"))
    estimate.clusters =
        list_of(read_plot_features(path / "clusters.geojson", "").plots, &PlotFeature::box);
  if (estimate.plots.empty() && estimate.method.empty()) throw InputError(file, "has no plots");
  const bool any_height = std::ranges::any_of(
      estimate.plots, [](const PlotEstimate& plot) { return !plot.heights_m.empty(); });
  if (!any_height && !estimate.plots.empty()) {
    throw InputError(file,
                     "no plot has a height; a height is a number in a property "
                     "height_<name>_m, such as height_raw-p99_m");
  }
  return estimate;
}

int trial_of(const PlotFeature& feature) {
  return integer_of(feature.properties, "trial_number", 0);
}

PlotEstimate plot_of(const PlotFeature& feature, std::size_t number) {
  PlotEstimate plot{.id = id_of(feature, number),
                    .trial = trial_of(feature),
                    .row = integer_of(feature.properties, "row_number", 0),
                    .column = integer_of(feature.properties, "col_number", 0),
                    .box = feature.box,
                    .points = integer_of(feature.properties, "points", std::size_t{0})};
  for (const auto& [property, value] : feature.properties.items()) {
    const std::string name = height_of(property);
    if (!name.empty() && value.is_number()) plot.heights_m[name] = value.get<double>();
  }
  plot.box_error = box_error_of(feature.properties);
  plot.errors = errors_of(feature.properties, plot.heights_m);
  plot.flags = stated_flags(feature.properties);
  plot.ground = ground_of(feature.properties);
  const auto confidence = feature.properties.find("confidence");
  if (confidence != feature.properties.end() && confidence->is_number())
    plot.confidence = confidence->get<double>();
  return plot;
}

std::vector<PlotEstimate> plots_of(const std::vector<PlotFeature>& features, const fs::path& file) {
  std::vector<PlotEstimate> plots;
  std::set<PlotId> ids;
  for (const PlotFeature& feature : features) {
    plots.push_back(plot_of(feature, plots.size() + 1));
    const PlotId& id = plots.back().id;
    if (!ids.insert(id).second) throw InputError(file, "has two plots with the id " + id.text());
    require_plausible(plots.back(), file);
  }
  return plots;
}

}  // namespace plotscan::estimate
