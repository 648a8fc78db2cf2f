// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/coordinate_units.h"
#include "core/plot_box.h"
#include "core/plot_features.h"
#include "estimate/diagnostics.h"
#include "ground/surface.h"

namespace plotscan::estimate {

// The uncertainty that a method states for one of its heights, metres.
struct HeightError {
  double standard_error_m = 0;
  double low95_m = 0;  // ends of the 95 % interval
  double high95_m = 0;
};

// The plane that a method uses as the ground under a plot, in the cloud's frame.
struct PlotGround {
  double z_m = 0;                                   // at the box's centre
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  // rise to a metre east, to a metre north
  double tolerance_m = 0;  // points no farther from the plane count as ground
};

// One plot as found in, or measured from, a cloud.
struct PlotEstimate {
  PlotId id = 0;   // as given, else a number from 1
  int trial = 0;   // from 1; 0 when the field is one trial, or the method has no trials
  int row = 0;     // of the trial, from 1; 0 when the method has no grid
  int column = 0;  // of the trial, from 1; 0 when the method has no grid
  PlotBox box;
  std::optional<PlotBoxError> box_error = std::nullopt;  // of a method that says how sure boxes are
  std::size_t points = 0;                                // cloud points the heights were taken from
  std::map<std::string, double> heights_m =
      {};  // by name, e.g. "raw-p99"; absent where it could not be measured
  std::map<std::string, HeightError> errors = {};   // of heights_m, by the same names
  std::optional<double> confidence = std::nullopt;  // that this is a plot, 0 to 1
  std::vector<std::string> flags = {};  // why not to trust the heights; none: they may be trusted
  std::optional<PlotGround> ground = std::nullopt;  // of a method that has a plane for each plot
  // Attributes that came with the plot's box (PlotMap), written to the output unchanged;
  // read_estimate does not read them.
  nlohmann::json attributes = nlohmann::json::object();
};

// The result of a method for a whole field.
struct Estimate {
  std::string method;  // "dhami2020"
  std::vector<PlotEstimate> plots = {};
  std::string id_property = "plot_number";  // the property and column that holds the plots' ids
  std::string crs = {};  // coordinate system of the boxes (write_plot_features); "" where unknown
  // Units of the cloud's file, where not metres. Written files use them; all else here is in
  // metres.
  std::optional<CoordinateUnits> units = {};
  Diagnostics diagnostics = {};                          // what the method learnt on its way
  std::optional<ground::Surface> ground = std::nullopt;  // in the cloud's frame
  ground::Field canopy_m = {};  // of the ground's nodes (highest_in_cells); empty without a ground
  // Boxes of the point clusters that the plots were made from (dhami2020: before the vote); else
  // empty.
  std::vector<PlotBox> clusters = {};
};

// The plots as write_estimate writes them.
std::vector<PlotFeature> features_of(const Estimate& estimate);

// Writes plots.geojson, plots.wgs84.geojson where the coordinate system is UTM's (utm_system) in
// metres, heights.csv and, where the method has them, the ground's grids, chm.asc and
// clusters.geojson (docs/estimate-format.md) into an existing folder.
void write_estimate(const std::filesystem::path& folder, const Estimate& estimate);

// Reads an estimate folder's plots.geojson, or a GeoJSON file, Plotscan's or anyone's: heights are
// its numeric properties named height_<name>_m or canopy_<name>_m; a plot's id is its feature's,
// else its plot_number, else its place in the file. The method is the one that the folder's
// manifest.json names, "" without a manifest. The ground's grids are not read. A file in longitude
// and latitude is brought into `crs`, which is UTM's. Throws InputError as estimated_map_of,
// read_plot_features and plots_of do, when no plot has a height, and when a file that no method of
// ours wrote has no plot.
Estimate read_estimate(const std::filesystem::path& path, const std::string& crs = "");

// The attributes of a feature in the user's map, to be written back (PlotEstimate::attributes): all
// its properties except the five of its box. Properties with a name that an estimate writes itself
// (heights, their errors, points, confidence, flags) are renamed given_<name>, so that nobody takes
// the map's values for measured ones.
nlohmann::json given_attributes(const PlotFeature& feature);

// Whether a map's features are an estimate's of ours, as written or saved again by a GIS: one of
// them has its box and `points`, and a height's standard error or a plane of ground.
bool is_of_estimate(const std::vector<PlotFeature>& features);

// The attributes of a feature in such a map: its properties except those that the estimate
// measured, and those that were named given_<name> in it.
nlohmann::json own_attributes(const PlotFeature& feature);

// The feature's property trial_number, a whole number; 0 without one.
int trial_of(const PlotFeature& feature);

// The plot that one feature of a plots.geojson describes; `number` is its place in the file, from
// 1.
PlotEstimate plot_of(const PlotFeature& feature, std::size_t number);

// The plots that the features of a file describe. Throws InputError when two have one id, and on a
// height that is not plausible (height_properties.h).
std::vector<PlotEstimate> plots_of(const std::vector<PlotFeature>& features,
                                   const std::filesystem::path& file);

}  // namespace plotscan::estimate
