// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/plot_features.h"
#include "estimate/estimate.h"

namespace plotscan::estimate {

// Plots given by the user: boxes, ids and further attributes of each.
struct PlotMap {
  std::vector<PlotFeature> plots = {};
  std::vector<PlotId> ids = {};  // of the plots, all different
  // The property that holds the ids; "plot_number" where none does, and plots are numbered from 1.
  std::string id_property = "plot_number";
  bool from_degrees = false;            // the file has longitude and latitude, which were converted
  std::vector<std::string> notes = {};  // what is odd about its boxes, a sentence each
};

inline constexpr double kMostPlot_m2 = 10000;  // of a given plot

// Reads a map of plots (GeoJSON, GeoPackage, shapefile, an estimate's folder) over a cloud in the
// coordinate system `crs`, `unit_m` metres to one unit of it: in these units, or in longitude and
// latitude where that is UTM's in metres (read_plot_features). The ids are those of the property
// `id_property`; without it of the first of plot_number, plot_id, plot_name, observationUnitName,
// observationunit_name, name and id that the plots have; "id" may be a member of the feature as
// well. Such a property counts whatever the case, underscores and blanks of its name ("Plot ID").
// Throws InputError as estimated_map_of and read_plot_features do, on a file without plots or with
// one over kMostPlot_m2, where some plots have an id and others none, and where two have the same:
// the message names them.
PlotMap read_plot_map(const std::filesystem::path& place, const std::string& crs, double unit_m,
                      const std::optional<std::string>& id_property = std::nullopt);

struct NamedPlot {
  PlotId id;
  nlohmann::json attributes = nlohmann::json::object();
};

// What a field book says of the plots, by row and column.
struct NamedPlaces {
  std::map<std::pair<int, int>, NamedPlot> plots = {};  // by row and column, from 1
  std::string id_property = {};                         // the column that holds the ids
};

// Reads a table of plots (read_csv_table) with columns row (or row_number), column (or col,
// col_number), the plots' id as in read_plot_map, and any others, which become attributes. All are
// texts and stay so. Throws InputError as these do, where a column is missing, and where two plots
// have one place.
NamedPlaces read_named_places(const std::filesystem::path& file,
                              const std::optional<std::string>& id_property = std::nullopt);

// Gives an estimate that was measured in the map's boxes, in their order, the map's ids, trials,
// rows, columns and attributes.
void take_names(const PlotMap& map, Estimate& estimate);

}  // namespace plotscan::estimate
