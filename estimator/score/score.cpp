// SPDX-License-Identifier: Apache-2.0
#include "score/score.h"

#include <cmath>

#include <fmt/core.h>

#include "core/error.h"
#include "core/extent.h"
#include "core/geodesy.h"
#include "core/list_of.h"
#include "core/plot_features.h"
#include "core/stated_system.h"
#include "core/statistics.h"
#include "estimate/height_properties.h"
#include "score/internal/farm_place.h"
#include "score/internal/matching.h"
#include "score/measured_table.h"

namespace plotscan::score {
namespace fs = std::filesystem;
namespace {

constexpr double kOnePlace = 0.5;  // boxes that overlap by more are of one plot

template <class Plot>
std::vector<PlotBox> boxes_of(const std::vector<Plot>& plots) {
  return list_of(plots, &Plot::box);
}

FoundPlot found_plot(const TruePlot& truth, const estimate::PlotEstimate& plot, double iou) {
  return {.estimate = plot.id,
          .iou = iou,
          .center_error_m = (plot.box.center - truth.box.center).norm(),
          .heading_error_rad = heading_difference(plot.box.heading_rad, truth.box.heading_rad),
          .heights_m = plot.heights_m,
          .errors = plot.errors,
          .confidence = plot.confidence,
          .flags = plot.flags};
}

bool lies_in_unscored(const std::vector<TruePlot>& truth, const PlotBox& box) {
  double inside_m2 = 0;
  for (const TruePlot& plot : truth) {
    if (!plot.scored) inside_m2 += intersection_area(plot.box, box);
  }
  return inside_m2 > 0 && 2 * inside_m2 >= box.area_m2();
}

// The truths that a plot's properties state, by their names.
std::map<std::string, double> truths_of(const nlohmann::json& properties) {
  std::map<std::string, double> truths_m;
  for (const auto& [name, value] : properties.items()) {
    if (!estimate::height_of(name).empty() && value.is_number())
      truths_m[name] = value.get<double>();
  }
  return truths_m;
}

// A plot that is there twice would be found once, and missed once.
void require_different_places(const std::vector<TruePlot>& plots, const fs::path& file) {
  const std::vector<PlotBox> boxes = boxes_of(plots);
  for (const PlotMatch& pair : overlapping_pairs(boxes, boxes, kOnePlace)) {
    if (pair.truth != pair.estimate)
      throw InputError(file, "has plots {} and {} at the same place; it must have each plot once",
                       plots[pair.truth].id.text(), plots[pair.estimate].id.text());
  }
}

// The UTM system of a truth, or of its place on Earth; "" without one.
std::string utm_beside(const fs::path& truth) {
  if (fs::is_directory(truth)) {
    const std::optional<Anchor> anchor = anchor_of(truth);
    return anchor ? utm_crs_of(*anchor) : "";
  }
  const std::string crs = is_measured_table(truth) ? "" : stated_system(truth).crs;
  return utm_system(crs) ? crs : "";
}

std::string extent_text(const Eigen::AlignedBox2d& extent) {
  return fmt::format("x {:.1f} to {:.1f}, y {:.1f} to {:.1f}", extent.min().x(), extent.max().x(),
                     extent.min().y(), extent.max().y());
}

double root_mean_square(const std::vector<double>& values) {
  return std::sqrt(mean(list_of(values, [](double value) { return value * value; })));
}

}  // namespace

std::vector<TruePlot> read_truth(const fs::path& farm, const std::string& crs) {
  const fs::path file = fs::is_directory(farm) ? farm / "truth" / "plots.geojson" : farm;
  if (!fs::exists(file) && fs::exists(farm / "plots.geojson"))
    throw InputError(farm,
                     "is an estimate, and the truth is a farm's folder, or a map or table of "
                     "measured heights; to compare two estimates give its plots.geojson");
  const std::optional<UtmSystem> utm = utm_system(crs);
  std::vector<PlotFeature> features = read_plot_features(file, utm ? crs : "").plots;
  const std::optional<Anchor> anchor = utm ? anchor_of(farm) : std::nullopt;
  if (anchor) {
    for (PlotFeature& feature : features) feature.box = in_utm(feature.box, *anchor, utm->zone);
  }
  std::vector<TruePlot> plots;
  for (const estimate::PlotEstimate& plot : estimate::plots_of(features, file)) {
    plots.push_back({.id = plot.id,
                     .trial = plot.trial,
                     .row = plot.row,
                     .column = plot.column,
                     .box = plot.box,
                     .heights_m = truths_of(features[plots.size()].properties)});
  }
  if (plots.empty()) throw InputError(file, "has no plots");
  require_different_places(plots, file);
  return plots;
}

estimate::Estimate read_estimate_beside(const fs::path& truth, const fs::path& estimate) {
  const fs::path map = estimated_map_of(estimate);
  const bool in_degrees = fs::exists(map) && stated_system(map).in_degrees;
  return estimate::read_estimate(estimate, in_degrees ? utm_beside(truth) : "");
}

FieldScore score_field(const std::vector<TruePlot>& truth, const estimate::Estimate& estimate,
                       const ScoreOptions& options) {
  FieldScore field{.method = estimate.method, .plots = {}, .extra = {}};
  for (const TruePlot& plot : truth) field.plots.push_back({.truth = plot, .found = {}});
  const Matching matching = match_plots(boxes_of(truth), boxes_of(estimate.plots), options.min_iou);
  for (const PlotMatch& match : matching.matches) {
    field.plots[match.truth].found =
        found_plot(truth[match.truth], estimate.plots[match.estimate], match.iou);
  }
  std::erase_if(field.plots, [](const PlotScore& plot) { return !plot.truth.scored; });
  for (const std::size_t extra : matching.extra) {
    const estimate::PlotEstimate& plot = estimate.plots[extra];
    if (!lies_in_unscored(truth, plot.box)) field.extra.push_back(plot.id);
  }
  return field;
}

bool lie_apart(const std::vector<TruePlot>& truth, const estimate::Estimate& estimate) {
  const Eigen::AlignedBox2d true_extent = extent_of(truth, &TruePlot::box);
  const Eigen::AlignedBox2d extent = extent_of(estimate.plots, &estimate::PlotEstimate::box);
  return !true_extent.isEmpty() && !extent.isEmpty() && !true_extent.intersects(extent);
}

std::string apart_note(const std::vector<TruePlot>& truth, const estimate::Estimate& estimate) {
  if (!lie_apart(truth, estimate)) return "";
  return fmt::format(
      "All plots of the estimate lie apart from the true ones, and the two do not overlap at all: "
      "estimated plots lie within {}, true ones within {} (metres). Are both in the same "
      "coordinates? A farm is brought into an estimate's where it has an anchor and these are UTM.",
      extent_text(extent_of(estimate.plots, &estimate::PlotEstimate::box)),
      extent_text(extent_of(truth, &TruePlot::box)));
}

BoxScore score_boxes(std::span<const FieldScore> fields) {
  BoxScore boxes;
  std::vector<double> ious, center_errors_m, heading_errors_rad;
  for (const FieldScore& field : fields) {
    boxes.plots += field.plots.size();
    boxes.extra += field.extra.size();
    for (const PlotScore& plot : field.plots) {
      if (!plot.found) continue;
      ious.push_back(plot.found->iou);
      center_errors_m.push_back(plot.found->center_error_m);
      heading_errors_rad.push_back(plot.found->heading_error_rad);
    }
  }
  boxes.found = ious.size();
  boxes.missed = boxes.plots - boxes.found;
  boxes.recall = ratio(boxes.found, boxes.plots);
  boxes.precision = ratio(boxes.found, boxes.found + boxes.extra);
  boxes.iou_mean = mean(ious);
  boxes.iou_median = quantile(ious, 0.5);
  boxes.iou_min = quantile(ious, 0);
  boxes.center_rmse_m = root_mean_square(center_errors_m);
  boxes.heading_rmse_rad = root_mean_square(heading_errors_rad);
  return boxes;
}

}  // namespace plotscan::score
