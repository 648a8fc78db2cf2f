// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/lattice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/core.h>

#include "cloud/field_density.h"
#include "cloud/points_in_boxes.h"
#include "core/angle.h"
#include "core/csv.h"
#include "core/each_index.h"
#include "core/error.h"
#include "core/extent.h"
#include "core/list_of.h"
#include "core/stage.h"
#include "estimate/given_plots.h"
#include "estimate/ground_grids.h"
#include "heights/measure_heights.h"
#include "methods/lattice/internal/field_notes.h"
#include "methods/lattice/internal/field_report.h"
#include "methods/lattice/internal/layout_doubts.h"
#include "methods/lattice/internal/upside_down.h"
#include "methods/lattice/settings.h"
#include "plots/search/find_trials.h"

namespace plotscan::methods::lattice {
namespace {

using Points = std::vector<Eigen::Vector3f>;

constexpr int kMostThreads = 1024;
constexpr double kGroundAround_m = 4;  // read around given boxes, to see the ground beside them

void report(const ProgressReport& progress, double share) {
  if (progress) progress(share);
}

// Shares of the whole work done after its stages, as on a flight of 7.7 million points.
constexpr double kField = 0.2, kGround = 0.7, kAbove = 0.72, kPlots = 0.95;

ground::Surface ground_of(const cloud::FieldCloud& cloud, const Options& options,
                          const ProgressReport& progress) {
  const Stage stage("ground");
  const Points& points = cloud.ground_points.empty() ? cloud.points : cloud.ground_points;
  const auto so_far = [&](double share) { report(progress, kField + share * (kGround - kField)); };
  return ground::fit_surface(
      points, {.noise_m = options.noise_m, .threads = options.threads, .progress = so_far});
}

// Reports the work ahead to the caller, if it asked for that.
void report_work(const cloud::FieldCloud& cloud, const Options& options) {
  if (!options.on_work) return;
  options.on_work(estimate_work({.points = cloud.counts.read,
                                 .rectangle_m2 = cloud::sides_of(cloud.area).prod(),
                                 .density_m2 = cloud.density_m2},
                                options.threads));
}

// The field's points of the user's ground classes, in the field's frame.
Points read_ground_points(const CloudFiles& cloud, const cloud::FieldCloud& field,
                          const Options& options) {
  CloudFiles of_classes = cloud;
  of_classes.only_classes = options.ground_classes;
  cloud::FieldCloud ground =
      cloud::read_field(of_classes, {.area = field.area, .threads = options.threads});
  const Eigen::Vector3f moved = (ground.origin - field.origin).cast<float>();
  for (Eigen::Vector3f& point : ground.points) point += moved;
  return std::move(ground.points);
}

// (x, y, height above the ground) of the points that have ground within reach, in their order.
Points above_ground(Points points, const ground::Surface& surface, int threads) {
  const Stage stage("heights above the ground");
  for_each_index(points.size(), threads, [&](std::size_t i) {
    const double ground_z = surface.height(points[i].head<2>().cast<double>());
    points[i].z() = static_cast<float>(points[i].z() - ground_z);
  });
  std::erase_if(points, [](const Eigen::Vector3f& point) { return std::isnan(point.z()); });
  return points;
}

plots::Hints hints_of(const Options& options) {
  plots::Hints hints{.width_m = options.plot_width_m,
                     .length_m = options.plot_length_m,
                     .rows = options.rows,
                     .columns = options.columns,
                     .plots = options.plots};
  if (options.heading_deg) hints.heading_rad = radians(*options.heading_deg);
  return hints;
}

void add_plots(const plots::PlotField& trial, int number, const Options& options,
               std::vector<estimate::PlotEstimate>& found) {
  const bool stated = hints_of(options).tell_layout();
  const std::vector<std::string> doubts =
      trial.fit ? doubts_of(*trial.fit, stated) : std::vector<std::string>();
  for (const plots::FoundPlot& plot : trial.plots) {
    found.push_back({.id = static_cast<std::uint32_t>(found.size() + 1),
                     .trial = number,
                     .row = plot.row,
                     .column = plot.column,
                     .box = plot.box,
                     .box_error = plot.box_error});
    found.back().confidence = plot.confidence;
    if (!trial.rival.empty())
      found.back().flags.push_back("the canopy shows " + trial.rival + " more clearly");
    found.back().flags.insert(found.back().flags.end(), doubts.begin(), doubts.end());
    if (!trial.doubt.empty())
      found.back().flags.push_back("taken for a plot only as the layout is told (" + trial.doubt +
                                   ")");
    if (plot.cut_off) found.back().flags.emplace_back("reaches over the edge of the scanned area");
    if (plot.without_edge)
      found.back().flags.emplace_back(
          "canopy does not end at one of its sides (a guard plot, or another crop beside it)");
  }
}

// The plots that the field shows, or the given ones, in the map's own frame.
std::vector<estimate::PlotEstimate> plots_of(const cloud::FieldCloud& cloud, const Points& heights,
                                             const ground::Surface& surface, const Options& options,
                                             estimate::Diagnostics& diagnostics) {
  if (!options.boxes.empty()) {
    std::vector<estimate::PlotEstimate> given =
        estimate::given_plots(options.boxes, cloud.origin, options.trials);
    note_shift(heights, given, surface.noise_m, diagnostics);
    return given;
  }
  if (cloud.density_m2 < cloud::kLeastSearched_m2) {
    diagnostics.why_no_plots = too_few("plots");
    return {};
  }
  if (surface.noise_m > kMostNoise_m) {
    diagnostics.why_no_plots = fmt::format(
        "heights scatter by {:.1f} m about the lowest: no ground that plots could stand on (z has "
        "to point up)",
        surface.noise_m);
    return {};
  }
  Stage stage("plots");
  const std::vector<plots::PlotField> trials = plots::find_trials(
      heights, surface.noise_m, hints_of(options), options.threads,
      [&](const Eigen::Vector2d& place) { return surface.standard_error(place); });
  report_trials(trials, diagnostics);
  note_heading(trials.front(), options, diagnostics);
  if (!trials.front().why_none.empty())
    diagnostics.why_no_plots =
        why_none(trials.front().why_none, cloud.density_m2, surface.noise_m, options);
  std::vector<estimate::PlotEstimate> found;
  for (std::size_t i = 0; i < trials.size(); ++i)
    add_plots(trials[i], trials.size() > 1 ? static_cast<int>(i + 1) : 0, options, found);
  stage.found(std::to_string(found.size()) + " plots");
  return found;
}

void take(const heights::PlotHeights& measured, estimate::PlotEstimate& plot) {
  plot.points = measured.points;
  for (const auto& [name, height] : measured.heights) {
    plot.heights_m[name] = height.value_m;
    plot.errors[name] = {height.standard_error_m, height.low95_m, height.high95_m};
  }
  plot.flags.insert(plot.flags.end(), measured.flags.begin(), measured.flags.end());
}

std::map<int, std::vector<std::size_t>> by_trial(const std::vector<estimate::PlotEstimate>& plots) {
  std::map<int, std::vector<std::size_t>> trials;
  for (std::size_t i = 0; i < plots.size(); ++i) trials[plots[i].trial].push_back(i);
  return trials;
}

// Trials are measured one by one, as each has a crop of its own.
void measure(std::vector<estimate::PlotEstimate>& plots, const Points& heights,
             const ground::Surface& surface, const Options& options,
             estimate::Diagnostics& diagnostics) {
  const Stage stage("plots' heights");
  const std::vector<PlotBox> boxes = list_of(plots, &estimate::PlotEstimate::box);
  const std::vector<Points> inside = cloud::points_in_boxes(heights, boxes);
  for (const auto& [trial, members] : by_trial(plots)) {
    const auto cloud_of = [&](std::size_t i) { return heights::PlotPoints{boxes[i], inside[i]}; };
    const heights::FieldHeights measured = heights::measure_heights(
        list_of(members, cloud_of), surface,
        {.calibrated = options.calibrated, .crop = options.crop, .threads = options.threads});
    for (std::size_t k = 0; k < members.size(); ++k) take(measured.plots[k], plots[members[k]]);
    if (!measured.crops.empty()) diagnostics.crops.push_back(measured.crops);
  }
}

estimate::PointAccount account_of(const cloud::FieldCloud& cloud, std::size_t with_ground) {
  using estimate::Unused;
  const cloud::FieldCounts& counts = cloud.counts;
  return {.read = counts.read,
          .in_area = counts.kept,
          .unused = {{Unused::not_finite, counts.not_finite},
                     {Unused::marked, counts.marked},
                     {Unused::left_out, counts.left_out},
                     {Unused::outside, counts.outside},
                     {Unused::repeated, counts.repeated},
                     {Unused::thinned, counts.thinned},
                     {Unused::outliers, counts.outliers},
                     {Unused::without_ground, counts.kept - with_ground}},
          .area_m = cloud.area};
}

constexpr std::size_t kLeastOfGround = 3;  // points with ground beneath them: fewer are no surface

// Throws NothingToMeasure if all points lie in one place, as a field in degrees does.
void require_extent(const Points& points) {
  constexpr float kShortestSide_m = 0.1f;
  Eigen::AlignedBox2f extent;
  for (const Eigen::Vector3f& point : points) extent.extend(point.head<2>());
  if (points.size() <= 1 || extent.sizes().maxCoeff() == 0 ||
      extent.sizes().maxCoeff() >= kShortestSide_m)
    return;
  throw NothingToMeasure(
      "all points lie within 10 cm of one place; give --crs EPSG:4326 if x and y "
      "are longitude and latitude, else --units");
}

// Throws NothingToMeasure if z points down: plots would be pits, and alleys canopy.
void require_upright(const Points& points, const ground::Surface& surface) {
  if (!is_upside_down(points, surface.noise_m)) return;
  throw NothingToMeasure(
      "z points down here: what stands on the ground lies below it; change the sign of z, and "
      "swap x and y (or change the sign of one of them) so that the field is not mirrored");
}

estimate::GroundFacts facts_of(const ground::Surface& surface) {
  std::size_t within = 0;
  std::size_t seen = 0;
  for (std::size_t node = 0; node < surface.z_m.size(); ++node) {
    within += std::isfinite(surface.z_m[node]);
    seen += std::isfinite(surface.z_m[node]) && surface.seen[node];
  }
  const auto known = static_cast<double>(within);
  return {.cell_m = surface.cell_m,
          .nodes = within,
          .seen_share = within > 0 ? static_cast<double>(seen) / known : 0,
          .unknown_share = 1 - known / static_cast<double>(surface.z_m.size()),
          .noise_m = surface.noise_m};
}

ground::Surface moved(ground::Surface surface, const Eigen::Vector3d& by) {
  surface.origin += by.head<2>();
  for (float& z : surface.z_m) z += static_cast<float>(by.z());
  return surface;
}

void require_ground_points(const cloud::FieldCloud& cloud, const Options& options) {
  if (!options.ground_classes.empty() && cloud.ground_points.empty())
    throw InputError("the cloud has no points of the ground's classes that are given");
}

FoundField found_in(cloud::FieldCloud cloud, const Options& options,
                    const ProgressReport& progress) {
  require_ground_points(cloud, options);
  require_extent(cloud.points);
  estimate::Estimate estimate{.method = "lattice"};
  note_steps(cloud, estimate.diagnostics);
  estimate.diagnostics.density_per_m2 = cloud.density_m2;
  report_work(cloud, options);
  ground::Surface surface = ground_of(cloud, options, progress);
  note_noise(surface, options, estimate.diagnostics);
  require_upright(cloud.points, surface);
  Points heights = above_ground(std::move(cloud.points), surface, options.threads);
  estimate.diagnostics.points = account_of(cloud, heights.size());
  if (heights.size() < kLeastOfGround)
    throw NothingToMeasure(no_ground_because(cloud, *estimate.diagnostics.points));
  report(progress, kAbove);
  estimate.diagnostics.ground = facts_of(surface);
  estimate.plots = plots_of(cloud, heights, surface, options, estimate.diagnostics);
  report(progress, kPlots);
  return {std::move(heights), std::move(surface), cloud.origin, std::move(estimate)};
}

}  // namespace

void require_sound(const Options& options) {
  if (options.crop_box) cloud::require_area(*options.crop_box, "crop box");
  require_settings(settings(), options);
  require_in_range("threads", options.threads, {1, kMostThreads});
  if (options.crop && !options.calibrated)
    throw InputError("a crop is for the calibration, which is left out: give one or the other");
  if (options.plot_width_m && options.plot_length_m &&
      *options.plot_width_m > *options.plot_length_m) {
    throw InputError("plot_width_m " + format_number(*options.plot_width_m) +
                     " is larger than plot_length_m " + format_number(*options.plot_length_m) +
                     "; a plot's length is its longer side");
  }
}

cloud::FieldOptions field_options(const Options& options) {
  if (options.crop_box || options.boxes.empty())
    return {.area = options.crop_box, .threads = options.threads};
  return {.area = cloud::around(extent_of(options.boxes), kGroundAround_m),
          .area_name = "given boxes",
          .threads = options.threads};
}

estimate::Estimate estimate_plots(cloud::FieldCloud cloud, const Options& options,
                                  const ProgressReport& progress) {
  require_sound(options);
  return measure_field(found_in(std::move(cloud), options, progress), options, progress);
}

FoundField find_field(const CloudFiles& cloud, const Options& options,
                      const ProgressReport& progress) {
  require_sound(options);
  cloud::FieldCloud field = cloud::read_field(
      cloud, field_options(options), [&](double share) { report(progress, kField * share); });
  if (!options.ground_classes.empty())
    field.ground_points = read_ground_points(cloud, field, options);
  return found_in(std::move(field), options, progress);
}

estimate::Estimate measure_field(const FoundField& field, const Options& options,
                                 const ProgressReport& progress) {
  estimate::Estimate estimate = field.estimate;
  measure(estimate.plots, field.heights, field.surface, options, estimate.diagnostics);
  for (estimate::PlotEstimate& plot : estimate.plots) plot.box.center += field.origin.head<2>();
  estimate.canopy_m = estimate::highest_in_cells(field.heights, field.surface);
  estimate.ground = moved(field.surface, field.origin);
  report(progress, 1);
  return estimate;
}

estimate::Estimate estimate_plots(const CloudFiles& cloud, const Options& options,
                                  const ProgressReport& progress) {
  return measure_field(find_field(cloud, options, progress), options, progress);
}

}  // namespace plotscan::methods::lattice
