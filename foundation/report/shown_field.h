// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/plot_box.h"
#include "report/shown_cloud.h"

namespace plotscan::report {

// A height and its uncertainty, metres; NaN where the method gives none.
struct ShownHeight {
  double value_m = 0;
  double standard_error_m = 0;
  double low95_m = 0;
  double high95_m = 0;
};

// What a comparison with the truth says of a plot.
enum class PlotState : std::uint8_t { unscored, found, extra };

// A plot of an estimate or, in a scan's page, of a map.
struct ShownPlot {
  std::string id;
  int trial = 0;   // from 1; 0: the only one
  int row = 0;     // from 1; 0: unknown
  int column = 0;  // from 1; 0: unknown
  PlotBox box;     // in the frame of the field's cloud, metres
  std::optional<std::uint64_t> points = {};
  std::map<std::string, ShownHeight> heights = {};  // by name, "max"
  std::optional<double> confidence = {};
  std::vector<std::string> flags = {};
  PlotState state = PlotState::unscored;
  std::map<std::string, double> truths_m = {};  // of a found plot, by attribute, "height_max_m"
};

// A true plot's box.
struct ShownBox {
  std::string id;
  PlotBox box;
  bool found = false;
};

// The plane that a method took for the ground under a plot.
struct ShownPlane {
  std::string id;  // of the plot
  PlotBox box;
  double z_m = 0;  // at the box's centre
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  double tolerance_m = 0;  // points no farther from it count as ground
};

// How a method found its plots: the boxes of the clusters from which it made the plots' boxes, and
// the ground planes under these. Either may be empty.
struct ShownWorking {
  std::string method;
  std::vector<PlotBox> clusters = {};
  std::vector<PlotBox> plots = {};
  std::vector<ShownPlane> planes = {};
};

// Heights of the nodes of a square grid, rows from south to north; NaN where there is none.
struct ShownGrid {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();  // the south-western node, cloud frame, metres
  double cell_m = 0;
  int columns = 0;
  int rows = 0;
  std::vector<float> z_m = {};
  std::vector<float> standard_error_m = {};  // empty: not known
};

// A fact to show about a field, such as "points read: 7,735,305".
struct Fact {
  std::string name;
  std::string value;
};

// One field in three dimensions and as a map. All of it may be absent.
struct ShownField {
  std::string name;
  std::vector<Fact> facts = {};
  std::vector<std::string> notes = {};  // sentences
  std::optional<ShownCloud> cloud = {};
  std::optional<ShownGrid> ground = {};    // fitted
  std::optional<ShownGrid> terrain = {};   // true
  std::vector<Eigen::Vector3d> path = {};  // of the drone
  std::vector<ShownPlot> plots = {};
  std::vector<ShownBox> true_boxes = {};
  std::vector<ShownWorking> workings = {};  // of methods that report any
};

// What a page calls a file or folder: the last part of its path that is a name, "scan" of
// "field/scan/" and of "." there.
std::string shown_name(const std::filesystem::path& path);

// Adds a note if no point of the field's cloud, which it calls `cloud`, lies in the rectangle
// around the plots.
void note_cloud_elsewhere(ShownField& field, const std::string& cloud);

// The field as pages hold it (docs/report-format.md), with binary values for write_page.
nlohmann::json packed_field(const ShownField& field);

}  // namespace plotscan::report
