// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plotscan/error.h"
#include "plotscan/export.h"
#include "plotscan/plots.h"
#include "plotscan/points.h"
#include "plotscan/progress.h"
#include "plotscan/settings.h"

namespace plotscan {

// Every setting of a method, "lattice" or "dhami2020"; `lattice` needs none of them
// (docs/methods.md). Throws BadInput on another name.
PLOTSCAN_API std::vector<Setting> estimate_settings(const std::string& method = "lattice");

// Options for estimating a field.
struct EstimateOptions {
  // Use only the points in here: x0, y0, x1, y1, in the cloud's units; else the densely scanned
  // field is found.
  std::optional<std::array<double, 4>> crop_box = {};
  // Given plots, all of one crop: heights only, none is searched.
  std::vector<Box> boxes = {};
  std::map<std::string, SettingValue> settings = {};  // of the method, by their keys
  int threads = 0;  // 0: one for each processor; results are the same
};

// The ground under a field as heights of a square grid's nodes: node (column, row) lies at
// (x_m, y_m) + cell_m * (column, row) and has index row * columns + column.
struct GroundGrid {
  double x_m = 0;
  double y_m = 0;
  double cell_m = 0;
  int columns = 0;
  int rows = 0;
  std::vector<float> z_m = {};   // NaN where no ground is within reach
  std::vector<float> sd_m = {};  // standard error of z_m; NaN where that is
};

// A method's result for a whole field, in the cloud's frame, metres.
struct FieldEstimate {
  std::string method;
  std::vector<Plot> plots = {};
  std::string why_no_plots = {};          // why there are no plots; "" where there are some
  std::optional<GroundGrid> ground = {};  // where the method models it
  std::string crs = {};                   // of the cloud, "EPSG:<code>"; "" where unknown
  std::string geojson = {};               // plots.geojson as the program writes it
  std::string diagnostics = {};           // what the method learnt on its way, JSON
};

// Finds the plots of a cloud held in memory and measures their heights, by the method `lattice`:
// what `estimator run` does with the same points in a file. A field without plots has an estimate
// without plots, which says why. The points stay in the caller's memory; the copy that the method
// keeps takes 8 to 16 bytes per point (docs/library.md). Throws BadInput on options out of their
// range, on boxes without finite sides above 0, on settings of the search beside boxes, and when no
// point is finite or lies in the area, NothingMeasured when the points show no ground.
PLOTSCAN_API FieldEstimate estimate_field(const PointsView& points,
                                          const EstimateOptions& options = {},
                                          const Progress& progress = {});

// Options for estimating clouds in files into an estimate folder; `estimator run --help` explains
// them.
struct EstimateFilesOptions {
  EstimateOptions field = {};      // without boxes of its own: `boxes` names their file
  std::string method = "lattice";  // or "dhami2020", which needs the setting `plots`
  std::optional<std::filesystem::path> boxes = {};  // a map, or an estimate's folder
  // Property of the map, or column of plot_names and measured, that holds the plots' ids.
  std::optional<std::string> id = {};
  std::optional<std::string> units =
      {};  // of the coordinates, m, cm, mm, ft or us-ft; else the file's
  std::optional<std::string> crs = {};  // of the coordinates, "EPSG:<code>"; else the file's
  // Of recordings: a pcap's trajectory, sensor (a shipped one's name, or a file) and mount in the
  // body's frame (roll, pitch, yaw); the topic of the clouds in a bag or MCAP.
  std::optional<std::filesystem::path> trajectory = {};
  std::optional<std::string> sensor = {};
  std::optional<std::array<double, 3>> mount_rpy_deg = {};
  std::string topic = {};
  std::vector<int> leave_out_classes = {};  // ASPRS classes, 0 to 255
  // How the plots that are found are numbered, or a table of names by row and column.
  std::optional<std::uint32_t> first_number = {};
  std::optional<std::string> numbering = {};     // "zigzag" or "serpentine"
  std::optional<std::string> first_corner = {};  // "sw", "se", "nw" or "ne"
  std::optional<std::filesystem::path> plot_names = {};
  // A table of heights measured by hand in some plots, with which the estimate's are made to agree.
  std::optional<std::filesystem::path> measured = {};
  std::optional<std::filesystem::path> csv = {};  // a table for breeding databases as well
  std::uint64_t seed = 1;
  bool replace = false;  // an estimate folder, a table that exists
};

// What `estimator run` does: reads the clouds as one (PCD, PLY, LAS, text, scan folders, folders of
// tiles, recordings), writes the estimate folder (docs/estimate-format.md) and returns what it
// holds; of a field without plots too, whose estimate says why. Throws BadInput on bad input,
// NothingMeasured when the points show no ground, and leaves nothing behind then.
PLOTSCAN_API FieldEstimate estimate_files(const std::vector<std::filesystem::path>& clouds,
                                          const std::filesystem::path& folder,
                                          const EstimateFilesOptions& options = {},
                                          const Progress& progress = {});

}  // namespace plotscan
