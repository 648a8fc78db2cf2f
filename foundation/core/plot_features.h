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

namespace plotscan {

// One plot of a plots.geojson: its box and its attributes. `properties` holds what the writer knows
// of the plot beyond the box: "plot_number" (from 1), "row_number", "col_number" (from 1), heights
// such as "height_max_m".
struct PlotFeature {
  PlotBox box;
  nlohmann::json properties = nlohmann::json::object();
};

// GeoJSON (RFC 7946 layout) FeatureCollection, one Polygon a plot, in local metres: the file says
// so in a "coordinate_system" member, as RFC 7946 section 4 allows by prior arrangement. Each
// feature also carries its box exactly: center_x_m, center_y_m, width_m, length_m, heading_deg.
// Where the metres are those of a known system, `crs` names it, and so does a member "crs" of the
// file: "EPSG:<code>" as GeoJSON 2008 (section 3; cited from memory) has it, which GIS programs
// read; else as the text itself.
// With `units`, the polygons are in these in place of metres, and a member "coordinate_units_m"
// says so (metres to one unit, "x_y" and "z"); the attributes stay metres.
void write_plot_features(const std::filesystem::path& path, const std::vector<PlotFeature>& plots,
                         const std::string& crs = "",
                         const std::optional<CoordinateUnits>& units = {});

// The same with each corner as WGS84 longitude and latitude, degrees, as RFC 7946 wants them:
// `lonlat_deg_from_world` gives them. The box among the attributes stays in local metres.
void write_plot_features_wgs84(
    const std::filesystem::path& path, const std::vector<PlotFeature>& plots,
    const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& lonlat_deg_from_world);

// Reads what write_plot_features writes, and any FeatureCollection of four-cornered polygons (from
// QGIS, say): there the box is the rectangle with the polygon's centroid and mean side lengths,
// length the longer side. Polygons are in the units that the file names, else in `unit_m`. Throws
// InputError on a missing file, broken JSON, a polygon that is no near-rectangle, a non-finite
// number.
std::vector<PlotFeature> read_plot_features(const std::filesystem::path& path, double unit_m = 1);

// The units that a file of write_plot_features names; nothing where it names none.
std::optional<CoordinateUnits> read_coordinate_units(const std::filesystem::path& path);

}  // namespace plotscan
