// SPDX-License-Identifier: Apache-2.0
#include "core/plot_features.h"

#include <cmath>
#include <fstream>
#include <numbers>

#include "core/error.h"

namespace plotscan {
namespace {

using nlohmann::json;

constexpr double kDegrees = std::numbers::pi / 180;
// A polygon whose opposite sides differ by more than this share of their length is not a plot's
// rectangle.
constexpr double kRectangleTolerance = 0.05;
// A polygon and the box among its attributes are the same plot within this share of its size:
// programs round coordinates, to centimetres at the coarsest.
constexpr double kAgreementTolerance = 0.01;

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
  properties["center_x_m"] = plot.box.center.x();
  properties["center_y_m"] = plot.box.center.y();
  properties["width_m"] = plot.box.width_m;
  properties["length_m"] = plot.box.length_m;
  properties["heading_deg"] = plot.box.heading_rad / kDegrees;
  return {{"type", "Feature"},
          {"geometry",
           {{"type", "Polygon"}, {"coordinates", json::array({ring_of(plot.box, projection)})}}},
          {"properties", properties}};
}

// As GeoJSON 2008 names systems; well-known text that names no code stands there as it is.
json crs_member(const std::string& crs) {
  constexpr std::string_view kPrefix = "EPSG:";
  const std::string name =
      crs.starts_with(kPrefix) ? "urn:ogc:def:crs:EPSG::" + crs.substr(kPrefix.size()) : crs;
  return {{"type", "name"}, {"properties", {{"name", name}}}};
}

json collection(const std::vector<PlotFeature>& plots, const std::string& coordinate_system,
                const Projection& projection) {
  json features = json::array();
  for (const PlotFeature& plot : plots) features.push_back(feature_of(plot, projection));
  return {{"type", "FeatureCollection"},
          {"coordinate_system", coordinate_system},
          {"features", features}};
}

void write_document(const std::filesystem::path& path, const json& document) {
  std::ofstream out(path);
  out << document.dump(1) << '\n';
  if (!out.flush()) throw InputError(path, "cannot be written");
}

bool has_exact_box(const json& properties) {
  for (const char* name : {"center_x_m", "center_y_m", "width_m", "length_m", "heading_deg"}) {
    if (!properties.contains(name) || !properties[name].is_number()) return false;
  }
  return true;
}

PlotBox exact_box(const json& properties) {
  return {
      .center = {properties["center_x_m"].get<double>(), properties["center_y_m"].get<double>()},
      .width_m = properties["width_m"].get<double>(),
      .length_m = properties["length_m"].get<double>(),
      .heading_rad = properties["heading_deg"].get<double>() * kDegrees};
}

bool nearly_equal(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a - b).norm() <= kRectangleTolerance * std::max(a.norm(), b.norm());
}

// The outer ring of a Polygon, or of a MultiPolygon of one part, as GIS programs export it.
const json& polygon_ring(const json& feature, const std::string& which) {
  const json geometry = feature.contains("geometry") ? feature["geometry"] : json();
  const std::string type = geometry.is_object() ? geometry.value("type", "") : "null";
  if (type == "Polygon") return feature["geometry"].at("coordinates").at(0);
  if (type == "MultiPolygon" && geometry.at("coordinates").size() == 1) {
    return feature["geometry"].at("coordinates").at(0).at(0);
  }
  throw InputError(which + " has geometry \"" + type + "\"; a plot is a Polygon of four corners");
}

PlotBox rectangle_of(const json& ring, double unit_m, const std::string& which) {
  std::vector<Eigen::Vector2d> corners;
  for (const json& position : ring) {
    corners.emplace_back(unit_m * position.at(0).get<double>(),
                         unit_m * position.at(1).get<double>());
  }
  if (corners.size() == 5 && corners.front() == corners.back()) corners.pop_back();
  if (corners.size() != 4)
    throw InputError(which + " has " + std::to_string(corners.size()) + " corners; a plot has 4");
  const Eigen::Vector2d side = corners[1] - corners[0];
  const Eigen::Vector2d other = corners[2] - corners[1];
  const bool square_corners =
      std::abs(side.dot(other)) <= kRectangleTolerance * side.norm() * other.norm();
  if (!square_corners || !nearly_equal(side, corners[2] - corners[3]) ||
      !nearly_equal(other, corners[3] - corners[0])) {
    throw InputError(which + " is not a rectangle");
  }
  const bool side_is_length = side.norm() >= other.norm();
  const Eigen::Vector2d length = side_is_length ? side : other;
  const Eigen::Vector2d width = side_is_length ? other : side;
  return {.center = (corners[0] + corners[1] + corners[2] + corners[3]) / 4,
          .width_m = width.norm(),
          .length_m = length.norm(),
          .heading_rad = wrap_heading(std::atan2(length.y(), length.x()))};
}

void require_sound(const PlotBox& box, const std::string& which) {
  const bool finite = box.center.allFinite() && std::isfinite(box.width_m) &&
                      std::isfinite(box.length_m) && std::isfinite(box.heading_rad);
  if (!finite || box.width_m <= 0 || box.length_m <= 0) {
    throw InputError(which + " has no finite box of positive width and length");
  }
}

// A polygon that was moved in a GIS, its old box still among its attributes, would be silently
// ignored.
void require_agreement(const PlotBox& box, const PlotBox& polygon, const std::string& which) {
  const double apart = (box.center - polygon.center).norm();
  const double allowed = kAgreementTolerance * (1 + box.length_m + box.width_m);
  const bool same = apart <= allowed &&
                    std::abs(box.area_m2() - polygon.area_m2()) <= allowed * box.length_m &&
                    intersection_over_union(box, polygon) > 1 - kRectangleTolerance;
  if (same) return;
  throw InputError(which +
                   ": its polygon is not the box that its properties center_x_m, center_y_m, "
                   "width_m, length_m and "
                   "heading_deg give; remove these five where the polygon is right");
}

PlotFeature read_feature(const json& feature, double unit_m, const std::string& which) {
  PlotFeature plot;
  if (feature.contains("properties") && feature["properties"].is_object())
    plot.properties = feature["properties"];
  const PlotBox polygon = rectangle_of(polygon_ring(feature, which), unit_m, which);
  plot.box = has_exact_box(plot.properties) ? exact_box(plot.properties) : polygon;
  require_sound(plot.box, which);
  require_agreement(plot.box, polygon, which);
  return plot;
}

constexpr const char* kUnits = "coordinate_units_m";

std::optional<CoordinateUnits> units_of(const json& document) {
  if (!document.contains(kUnits)) return std::nullopt;
  return CoordinateUnits{.horizontal_m = document[kUnits].at("x_y").get<double>(),
                         .vertical_m = document[kUnits].at("z").get<double>()};
}

// What `read` makes of the file as JSON.
template <class Result>
Result read_document(const std::filesystem::path& path,
                     const std::function<Result(const json&)>& read) {
  try {
    return read(json::parse(read_text(path)));
  } catch (const json::exception& error) {
    throw InputError(path,
                     std::string("not a GeoJSON FeatureCollection of polygons: ") + error.what());
  }
}

}  // namespace

void write_plot_features(const std::filesystem::path& path, const std::vector<PlotFeature>& plots,
                         const std::string& crs, const std::optional<CoordinateUnits>& units) {
  const double unit_m = units ? units->horizontal_m : 1;
  const std::string unit = unit_name(unit_m);
  json document =
      collection(plots,
                 crs.empty() ? "local " + unit + ", x east, y north; not WGS84"
                             : unit + " of the system in member crs, x east, y north; not WGS84",
                 [unit_m](const Eigen::Vector2d& corner) { return corner / unit_m; });
  if (!crs.empty()) document["crs"] = crs_member(crs);
  if (units) document[kUnits] = {{"x_y", units->horizontal_m}, {"z", units->vertical_m}};
  write_document(path, document);
}

void write_plot_features_wgs84(const std::filesystem::path& path,
                               const std::vector<PlotFeature>& plots,
                               const Projection& lonlat_deg_from_world) {
  write_document(path, collection(plots,
                                  "WGS84 longitude, latitude in degrees; attributes in local "
                                  "metres, x east, y north",
                                  lonlat_deg_from_world));
}

std::vector<PlotFeature> read_plot_features(const std::filesystem::path& path, double unit_m) {
  return read_document<std::vector<PlotFeature>>(path, [&](const json& document) {
    const std::optional<CoordinateUnits> units = units_of(document);
    std::vector<PlotFeature> plots;
    for (const json& feature : document.at("features")) {
      plots.push_back(
          read_feature(feature, units ? units->horizontal_m : unit_m,
                       path.string() + ": feature " + std::to_string(plots.size() + 1)));
    }
    return plots;
  });
}

std::optional<CoordinateUnits> read_coordinate_units(const std::filesystem::path& path) {
  return read_document<std::optional<CoordinateUnits>>(path, units_of);
}

}  // namespace plotscan
