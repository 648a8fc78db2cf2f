// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/coordinate_units.h"
#include "core/plot_box.h"
#include "core/plot_id.h"

namespace plotscan {

// One plot of a plots.geojson: its box and its attributes. `properties` holds what the writer knows
// of the plot beyond the box: "plot_number" (from 1), "row_number", "col_number" (from 1), heights
// such as "height_max_m".
struct PlotFeature {
  PlotBox box;
  nlohmann::json properties = nlohmann::json::object();
  std::optional<PlotId> id = std::nullopt;  // the feature's member "id" (RFC 7946, section 3.2)
};

// GeoJSON (RFC 7946 layout) FeatureCollection, one Polygon a plot, in local metres: the file says
// so in a "coordinate_system" member, as RFC 7946 section 4 allows by prior arrangement. Each
// feature also carries its box exactly: center_x_m, center_y_m, width_m, length_m, heading_deg.
// Where the metres are those of a known system, `crs` names it, and so does a member "crs" of the
// file, as "The GeoJSON Format Specification" of 2008 has it (section 3.1, a named CRS), which GIS
// programs read: "EPSG:<code>", which that section calls a legacy identifier; else the text itself.
// Where no system is known, the member is the well-known text of a local one, which keeps GIS
// programs from taking the metres for degrees.
// With `units`, the polygons are in these in place of metres, and a member "coordinate_units_m"
// says so (metres to one unit, "x_y" and "z"); the attributes stay metres.
void write_plot_features(const std::filesystem::path& path, const std::vector<PlotFeature>& plots,
                         const std::string& crs = "",
                         const std::optional<CoordinateUnits>& units = {});

// What write_plot_features writes.
nlohmann::json plot_collection(const std::vector<PlotFeature>& plots, const std::string& crs = "",
                               const std::optional<CoordinateUnits>& units = {});

// As write_plot_features, but with each corner in WGS84 longitude and latitude, degrees, as RFC
// 7946 wants them: `lonlat_deg_from_world` gives them. The box in the attributes stays in local
// metres.
void write_plot_features_wgs84(
    const std::filesystem::path& path, const std::vector<PlotFeature>& plots,
    const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& lonlat_deg_from_world);

// Whether the name is one of kBoxProperties, which write_plot_features adds to every feature.
bool is_box_property(const std::string& name);

// Names of properties that hold a plot's id in field books, Breedbase and BrAPI; the likeliest
// first.
const std::vector<std::string>& plot_id_properties();

// The id in that property of the feature; for "id", also the feature's own member "id".
std::optional<PlotId> id_in(const PlotFeature& plot, const std::string& property);

// The map that `place` stands for: itself, or that of an estimate's folder, or of a farm's. Throws
// InputError on a folder without one.
std::filesystem::path plot_map_of(const std::filesystem::path& place);

// The same for readers that must not see the truth by mistake: a farm's folder is refused as well.
std::filesystem::path estimated_map_of(const std::filesystem::path& place);

// Reads what write_plot_features writes, and any FeatureCollection of polygons that are nearly
// rectangles (from QGIS, say), in metres or the units that the file names: the box is the exact one
// in the properties, with which the polygon must agree, else the rectangle nearest to the polygon,
// length the longer side (core/internal/rectangle_fit.h). Throws InputError on a missing file,
// broken JSON, a polygon that is farther from a rectangle than rectangle_tolerance_m, a non-finite
// number, and a file that is in longitude and latitude.
std::vector<PlotFeature> read_plot_features(const std::filesystem::path& path);

// Plots in the metres of a coordinate system.
struct PlacedPlots {
  std::vector<PlotFeature> plots = {};
  bool from_degrees = false;  // the file has longitude and latitude, which were converted
  std::optional<CoordinateUnits> units = {};  // as the file states (write_plot_features)
  // The most decimals of its degrees, where they are so few that corners are off by centimetres.
  std::optional<int> few_decimals = {};
};

// Reads a map of plots that lies over a cloud. `crs` is the cloud's system ("EPSG:<code>", "" if
// unknown), `unit_m` the metres in one unit of its x and y. The file's positions are in the units
// that it names, else in `unit_m`. They are longitude and latitude in degrees if the file says so
// (its member crs or coordinate_system). A file that says nothing (RFC 7946) is also taken for
// degrees if `crs` is UTM in metres and no number exceeds 180 and 90. Degrees are converted, and a
// box in the properties is then ignored, as it is of another frame. Throws InputError as above; on
// degrees if `crs` is not UTM in metres; and on a file of another system.
PlacedPlots read_plot_features(const std::filesystem::path& path, const std::string& crs,
                               double unit_m = 1);

// The same for a document in memory; `path` names it in messages.
PlacedPlots plot_features_of(const nlohmann::json& document, const std::filesystem::path& path,
                             const std::string& crs, double unit_m = 1);

}  // namespace plotscan
