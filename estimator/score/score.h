// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/plot_box.h"
#include "estimate/estimate.h"

namespace plotscan::score {

// One true plot.
struct TruePlot {
  PlotId id = 0;   // as in the truth, else from 1
  int trial = 0;   // from 1; 0 where the field is one trial
  int row = 0;     // of the trial, from 1; 0 when unknown
  int column = 0;  // from 1; 0 when unknown
  PlotBox box;
  std::map<std::string, double> heights_m = {};  // by attribute, "height_max_m", "canopy_p95_m"
  bool scored = true;  // false: an estimate of this plot counts neither for nor against
};

// Reads the true plots of a farm folder (its truth/plots.geojson), or of any GeoJSON file whose
// plots carry numbers height_<name>_m or canopy_<name>_m, such as hand measurements. `crs` is the
// system of the estimate beside them ("" if unknown): where it is UTM in metres, a farm that knows
// its place on Earth (anchor) and a map in longitude and latitude are brought into it. Throws
// InputError as read_plot_features and estimate::plots_of do, when there is no plot, when two are
// at one place, and on an estimate's folder.
std::vector<TruePlot> read_truth(const std::filesystem::path& farm, const std::string& crs = "");

// Reads an estimate beside its truth (estimate::read_estimate): one in longitude and latitude comes
// in the UTM system that the truth is in, or could be brought into.
estimate::Estimate read_estimate_beside(const std::filesystem::path& truth,
                                        const std::filesystem::path& estimate);

// A true plot's match in the estimate: its errors and its estimated heights.
struct FoundPlot {
  PlotId estimate = 0;  // PlotEstimate::id
  double iou = 0;       // of the two boxes
  double center_error_m = 0;
  double heading_error_rad = 0;                              // between the length axes, 0 to pi / 2
  std::map<std::string, double> heights_m = {};              // by name, "raw-p99"
  std::map<std::string, estimate::HeightError> errors = {};  // PlotEstimate::errors
  std::optional<double> confidence = std::nullopt;           // PlotEstimate::confidence
  std::vector<std::string> flags = {};                       // PlotEstimate::flags
};

struct PlotScore {
  TruePlot truth;
  std::optional<FoundPlot> found;  // absent: missed
};

// An estimate of one field compared with its truth.
struct FieldScore {
  std::string method;
  std::vector<PlotScore> plots;  // every true plot that is scored
  std::vector<PlotId> extra;     // ids of estimated plots that are no true plot
};

struct ScoreOptions {
  double min_iou = 0.5;                // least intersection over union for a plot to count as found
  std::optional<std::string> id = {};  // column of a table of measured heights with the plots' ids
};

// Compares an estimate with the truth. Estimated plots that match an unscored true plot, or have
// half of their area in unscored plots, do not count as extra.
FieldScore score_field(const std::vector<TruePlot>& truth, const estimate::Estimate& estimate,
                       const ScoreOptions& options = {});

// Whether the plots of both lie apart as a whole, as those of different coordinates do: their
// rectangles share no place. False where one has no plots.
bool lie_apart(const std::vector<TruePlot>& truth, const estimate::Estimate& estimate);

// What to tell the user then, with the extents of both; "" otherwise.
std::string apart_note(const std::vector<TruePlot>& truth, const estimate::Estimate& estimate);

// How well plots were found, over one field or several together. Statistics of found plots are NaN
// when there are none, and so is a share of nothing.
struct BoxScore {
  std::size_t plots = 0;  // true ones
  std::size_t found = 0;
  std::size_t missed = 0;
  std::size_t extra = 0;
  double recall = 0;     // found / plots
  double precision = 0;  // found / (found + extra)
  double iou_mean = 0;
  double iou_median = 0;
  double iou_min = 0;
  double center_rmse_m = 0;
  double heading_rmse_rad = 0;
};

BoxScore score_boxes(std::span<const FieldScore> fields);

}  // namespace plotscan::score
