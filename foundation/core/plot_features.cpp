// SPDX-License-Identifier: Apache-2.0
#include "core/plot_features.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/contains.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/format_version.h"
#include "core/geodesy.h"
#include "core/internal/decimals.h"
#include "core/internal/rectangle_fit.h"
#include "core/json_text.h"
#include "core/list_of.h"
#include "core/place_json.h"
#include "core/stated_system.h"
#include "core/text_file.h"

namespace plotscan {
namespace {

using nlohmann::json;

constexpr const char* kMapName = "plots.geojson";

std::filesystem::path truth_in(const std::filesystem::path& farm) {
  return farm / "truth" / kMapName;
}

using Projection = std::function<Eigen::Vector2d(const Eigen::Vector2d&)>;

// Counter-clockwise, as RFC 7946 section 3.1.6 wants it.
json ring_of(const PlotBox& box, const Projection& projection) {
  json ring = json::array();
  for (const Eigen::Vector2d& corner : box.corners()) {
    const Eigen::Vector2d position = projection(corner);
    ring.push_back({position.x(), position.y()});
  }
  ring.push_back(ring.front());
  return ring;
}

json feature_of(const PlotFeature& plot, const Projection& projection) {
  json properties = plot.properties;
  properties.update(box_json(plot.box));
  json feature = {
      {"type", "Feature"},
      {"geometry",
       {{"type", "Polygon"}, {"coordinates", json::array({ring_of(plot.box, projection)})}}},
      {"properties", std::move(properties)}};
  if (plot.id) feature["id"] = *plot.id;
  return feature;
}

// The member "crs" of GeoJSON 2008. Well-known text that names no code is written as it is.
json crs_member(const std::string& crs) {
  constexpr std::string_view kPrefix = "EPSG:";
  const std::string name =
      crs.starts_with(kPrefix) ? "urn:ogc:def:crs:EPSG::" + crs.substr(kPrefix.size()) : crs;
  return {{"type", "name"}, {"properties", {{"name", name}}}};
}

// Where RFC 7946 has no member crs, coordinates are degrees. No program takes these for such.
std::string local_system(double unit_m) {
  return fmt::format(R"(LOCAL_CS["local",UNIT["{}",{}]])", unit_name(unit_m),
                     format_number(unit_m));
}

json collection(const std::vector<PlotFeature>& plots, const std::string& coordinate_system,
                const Projection& projection) {
  json features = json::array();
  for (const PlotFeature& plot : plots) features.push_back(feature_of(plot, projection));
  return {{"type", "FeatureCollection"},
          {"format", kFormat},
          {"coordinate_system", coordinate_system},
          {"features", std::move(features)}};
}

bool has_exact_box(const json& properties) {
  return std::ranges::all_of(kBoxProperties, [&](const char* name) {
    return properties.contains(name) && properties[name].is_number();
  });
}

// The outer ring of a Polygon, or of a MultiPolygon of one part, as GIS programs export it.
const json& polygon_ring(const json& feature, const std::string& which) {
  static const json kNone;
  const json& geometry = feature.contains("geometry") ? feature["geometry"] : kNone;
  const std::string type = geometry.is_object() ? geometry.value("type", "") : "null";
  if (type == "Polygon") return geometry.at("coordinates").at(0);
  if (type == "MultiPolygon" && geometry.at("coordinates").size() == 1)
    return geometry.at("coordinates").at(0).at(0);
  throw InputError(
      fmt::format("{} has geometry \"{}\"; a plot is a Polygon of four corners", which, type));
}

PlotBox rectangle_of(const json& ring, const Projection& metres, const std::string& which) {
  const std::vector<Eigen::Vector2d> corners = list_of(ring, [&](const json& position) {
    return metres({position.at(0).get<double>(), position.at(1).get<double>()});
  });
  const std::optional<RectangleFit> fit = fit_rectangle(corners);
  if (!fit) {
    throw InputError(fmt::format(
        "{} has {} positions; a plot's polygon has 4 corners, and at most 1000 positions", which,
        ring.size()));
  }
  const double allowed_m = rectangle_tolerance_m(fit->box);
  if (fit->off_m > allowed_m) {
    throw InputError(which +
                     fmt::format(" is not a rectangle: it is up to {:.2f} m off the nearest one, "
                                 "and {:.2f} m are allowed",
                                 fit->off_m, allowed_m));
  }
  return fit->box;
}

void require_sound(const PlotBox& box, const std::string& which) {
  const bool finite = box.center.allFinite() && std::isfinite(box.width_m) &&
                      std::isfinite(box.length_m) && std::isfinite(box.heading_rad);
  if (!finite || box.width_m <= 0 || box.length_m <= 0)
    throw InputError(fmt::format("{} has no finite box of positive width and length", which));
}

// A polygon that was moved in a GIS, its old box still among its attributes, would be silently
// ignored.
void require_agreement(const PlotBox& box, const PlotBox& polygon, const std::string& which) {
  const double allowed_m = rectangle_tolerance_m(box);
  const auto corners = polygon.corners();
  const bool same = std::ranges::all_of(box.corners(), [&](const Eigen::Vector2d& corner) {
    return std::ranges::any_of(corners, [&](const Eigen::Vector2d& other) {
      return (corner - other).norm() <= allowed_m;
    });
  });
  if (same) return;
  throw InputError(fmt::format(
      "{}: its polygon is not the box that its properties center_x_m, center_y_m, width_m, "
      "length_m and heading_deg give; remove these five where the polygon is right",
      which));
}

// "trial.geojson: feature 3", with the id that people know the plot by.
std::string name_of(const std::filesystem::path& path, std::size_t place, const PlotFeature& plot) {
  std::string feature = fmt::format("{}: feature {}", path.string(), place);
  for (const std::string& property : plot_id_properties())
    if (const auto id = id_in(plot, property))
      return fmt::format("{} ({} \"{}\")", feature, property, id->text());
  return feature;
}

// How a file's positions become metres.
struct Positions {
  Projection metres;
  bool in_degrees = false;
};

PlotFeature read_feature(const json& feature, const std::filesystem::path& path, std::size_t place,
                         const Positions& positions) {
  PlotFeature plot;
  if (feature.contains("properties") && feature["properties"].is_object())
    plot.properties = feature["properties"];
  if (feature.contains("id")) plot.id = PlotId::from(feature["id"]);
  const std::string which = name_of(path, place, plot);
  const PlotBox polygon = rectangle_of(polygon_ring(feature, which), positions.metres, which);
  plot.box = polygon;
  if (!positions.in_degrees && has_exact_box(plot.properties)) plot.box = box_from(plot.properties);
  require_sound(plot.box, which);
  require_agreement(plot.box, polygon, which);
  return plot;
}

constexpr const char* kUnits = "coordinate_units_m";

std::optional<CoordinateUnits> units_of(const json& document, const std::filesystem::path& path) {
  if (!document.contains(kUnits)) return std::nullopt;
  const CoordinateUnits units{.horizontal_m = document[kUnits].at("x_y").get<double>(),
                              .vertical_m = document[kUnits].at("z").get<double>()};
  const bool sound = units.horizontal_m > 0 && std::isfinite(units.horizontal_m) &&
                     units.vertical_m > 0 && std::isfinite(units.vertical_m);
  if (!sound) throw InputError(path, "{}: x_y and z must be metres above 0", kUnits);
  return units;
}

bool within_degrees(const json& coordinates) {
  // Only lists: a loop over a JSON text would visit the text itself, endlessly.
  if (!coordinates.is_array()) return false;
  if (!coordinates.empty() && coordinates[0].is_number()) {
    return std::abs(coordinates.at(0).get<double>()) <= 180 &&
           std::abs(coordinates.at(1).get<double>()) <= 90;
  }
  return std::ranges::all_of(coordinates, within_degrees);
}

// Whether positions are longitude and latitude. `over_utm`: the cloud is in metres of UTM.
bool is_in_degrees(const json& document, bool over_utm) {
  const StatedSystem stated = stated_system(document);
  if (stated.in_degrees) return true;
  const bool says_otherwise = !stated.crs.empty() || (document.contains("coordinate_system") &&
                                                      document["coordinate_system"].is_string());
  if (says_otherwise || !over_utm) return false;
  return std::ranges::all_of(document.at("features"), [](const json& feature) {
    return feature.contains("geometry") && feature["geometry"].is_object() &&
           within_degrees(feature["geometry"].value("coordinates", json::array()));
  });
}

// Whether both names may mean one system: either is "", they are equal, or both are UTM in one
// zone.
bool may_be_same(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty() || a == b) return true;
  const std::optional<UtmSystem> utm_a = utm_system(a);
  const std::optional<UtmSystem> utm_b = utm_system(b);
  return utm_a && utm_b && utm_a->zone.number == utm_b->zone.number &&
         utm_a->zone.north == utm_b->zone.north;
}

Projection from_degrees(const UtmZone& zone) {
  return [zone](const Eigen::Vector2d& lonlat_deg) -> Eigen::Vector2d {
    return utm_from_geodetic(zone,
                             {.latitude_deg = lonlat_deg.y(), .longitude_deg = lonlat_deg.x()})
        .head<2>();
  };
}

// The first position in nested lists of them; null where there is none.
const json& first_position(const json& coordinates) {
  static const json kNone;
  if (!coordinates.is_array() || coordinates.empty()) return kNone;
  return coordinates[0].is_number() ? coordinates : first_position(coordinates[0]);
}

// Throws where positions lie in the zone only with longitude and latitude in the wrong order.
void require_longitude_first(const json& document, const std::filesystem::path& path,
                             const UtmZone& zone) {
  constexpr double kNear_deg = 6;  // of the central meridian: the zone and a half beside it
  const auto is_near = [&](double longitude_deg) {
    return std::abs(std::remainder(longitude_deg - zone.central_meridian_deg(), 360.0)) <=
           kNear_deg;
  };
  for (const json& feature : document.at("features")) {
    if (!feature.contains("geometry") || !feature["geometry"].is_object()) continue;
    const json position = first_position(feature["geometry"].value("coordinates", json()));
    if (position.size() < 2 || !position[1].is_number()) continue;
    const double first = position[0].get<double>(), second = position[1].get<double>();
    if (is_near(first) || !is_near(second)) return;
    throw InputError(
        path,
        "has longitude {:g} and latitude {:g}, far from UTM zone {} of the cloud: they "
        "are probably swapped; a map has the longitude first",
        first, second, zone.number);
  }
}

Projection from_units(double unit_m) {
  return [unit_m](const Eigen::Vector2d& position) -> Eigen::Vector2d { return unit_m * position; };
}

// Decides it as read_plot_features documents.
Positions positions_of(const json& document, const std::filesystem::path& path,
                       const std::string& crs, double unit_m) {
  const std::optional<UtmSystem> utm = unit_m == 1 ? utm_system(crs) : std::nullopt;
  if (is_in_degrees(document, utm.has_value())) {
    if (utm) {
      require_longitude_first(document, path, utm->zone);
      return {.metres = from_degrees(utm->zone), .in_degrees = true};
    }
    throw InputError(path,
                     "is in longitude and latitude, which are converted only to UTM's metres, {}; "
                     "give the map in the cloud's coordinates",
                     crs.empty() ? "and no such system is known here (estimator run: --crs)"
                                 : "and the cloud is in " + crs);
  }
  if (const std::string stated = stated_system(document).crs; !may_be_same(stated, crs)) {
    throw InputError(
        path, "is in the coordinate system {}, and the cloud is in {}; give the map in the latter",
        stated, crs);
  }
  const std::optional<CoordinateUnits> units = units_of(document, path);
  return {.metres = from_units(units ? units->horizontal_m : unit_m)};
}

PlacedPlots placed_plots(const json& document, const std::filesystem::path& path,
                         const std::string& crs, double unit_m) {
  if (document.contains("coordinate_system")) require_known_format(document, path);  // ours
  const Positions positions = positions_of(document, path, crs, unit_m);
  PlacedPlots placed{.from_degrees = positions.in_degrees, .units = units_of(document, path)};
  if (positions.in_degrees) placed.few_decimals = few_decimals_of(document);
  for (const json& feature : document.at("features"))
    placed.plots.push_back(read_feature(feature, path, placed.plots.size() + 1, positions));
  return placed;
}

}  // namespace

bool is_box_property(const std::string& name) { return contains(kBoxProperties, name); }

json plot_collection(const std::vector<PlotFeature>& plots, const std::string& crs,
                     const std::optional<CoordinateUnits>& units) {
  const double unit_m = units ? units->horizontal_m : 1;
  const std::string unit = unit_name(unit_m);
  json document =
      collection(plots,
                 crs.empty() ? "local " + unit + ", x east, y north; not WGS84"
                             : unit + " of the system in member crs, x east, y north; not WGS84",
                 [unit_m](const Eigen::Vector2d& corner) { return corner / unit_m; });
  document["crs"] = crs_member(crs.empty() ? local_system(unit_m) : crs);
  if (units) document[kUnits] = {{"x_y", units->horizontal_m}, {"z", units->vertical_m}};
  return document;
}

void write_plot_features(const std::filesystem::path& path, const std::vector<PlotFeature>& plots,
                         const std::string& crs, const std::optional<CoordinateUnits>& units) {
  write_text_file(path, json_lines(plot_collection(plots, crs, units)));
}

void write_plot_features_wgs84(const std::filesystem::path& path,
                               const std::vector<PlotFeature>& plots,
                               const Projection& lonlat_deg_from_world) {
  write_text_file(
      path, json_lines(collection(plots,
                                  std::string(kDegreesStated) +
                                      " in degrees; attributes in local metres, x east, y north",
                                  lonlat_deg_from_world)));
}

const std::vector<std::string>& plot_id_properties() {
  static const std::vector<std::string> names = {
      "plot_number",          "plot_id", "plot_name", "observationUnitName",
      "observationunit_name", "name",    "id"};
  return names;
}

std::optional<PlotId> id_in(const PlotFeature& plot, const std::string& property) {
  const auto found = plot.properties.find(property);
  if (found != plot.properties.end()) return PlotId::from(*found);
  return property == "id" ? plot.id : std::nullopt;
}

std::filesystem::path plot_map_of(const std::filesystem::path& place) {
  const std::filesystem::path truth = truth_in(place);
  return std::filesystem::exists(truth) ? truth : estimated_map_of(place);
}

std::filesystem::path estimated_map_of(const std::filesystem::path& place) {
  if (!std::filesystem::is_directory(place)) return place;
  if (const auto truth = truth_in(place); std::filesystem::exists(truth)) {
    throw InputError(place,
                     "is a farm's folder, and its map is the truth; to use that all the same, "
                     "name the file: {}",
                     truth.string());
  }
  std::filesystem::path map = place / kMapName;
  if (!std::filesystem::exists(map))
    throw InputError(place, "is a folder without a map of plots ({})", kMapName);
  return map;
}

std::vector<PlotFeature> read_plot_features(const std::filesystem::path& path) {
  return read_plot_features(path, "").plots;
}

PlacedPlots read_plot_features(const std::filesystem::path& path, const std::string& crs,
                               double unit_m) {
  return plot_features_of(read_map_document(path), path, crs, unit_m);
}

PlacedPlots plot_features_of(const json& document, const std::filesystem::path& path,
                             const std::string& crs, double unit_m) {
  try {
    return placed_plots(document, path, crs, unit_m);
  } catch (const json::exception& error) {
    fail_no_map(path, error);
  }
}

}  // namespace plotscan
