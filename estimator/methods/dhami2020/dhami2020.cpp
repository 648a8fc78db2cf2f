// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/dhami2020.h"

#include <algorithm>
#include <string>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/extent.h"
#include "core/list_of.h"
#include "core/trial_layout.h"
#include "estimate/given_plots.h"
#include "methods/dhami2020/internal/ground_level.h"
#include "methods/dhami2020/internal/lattice.h"
#include "methods/dhami2020/internal/oriented_box.h"
#include "methods/dhami2020/internal/plot_grid.h"
#include "methods/dhami2020/internal/plot_heights.h"
#include "methods/dhami2020/internal/voting.h"
#include "methods/dhami2020/k_means.h"
#include "methods/dhami2020/settings.h"
#include "methods/dhami2020/voxel_filter.h"

namespace plotscan::methods::dhami2020 {
namespace {

using Cloud = std::vector<Eigen::Vector3f>;
using nlohmann::json;

constexpr int kMostThreads = 1024;

// The z filter: what stands more than min_height_m above the levelled ground.
Cloud canopy_of(const Cloud& voxels, const GroundLevel& level, double min_height_m) {
  return those_of(
      voxels, [&](const Eigen::Vector3f& point) { return level.height_of(point) > min_height_m; });
}

// The points in an area given in the world frame.
Cloud inside(const Cloud& points, const cloud::Area& area, const Eigen::Vector3d& origin) {
  return those_of(points, [&](const Eigen::Vector3f& point) {
    return cloud::holds(area, origin.head<2>() + point.head<2>().cast<double>());
  });
}

Clustering cluster(const Cloud& canopy, std::size_t voxels, const Options& options) {
  if (canopy.size() < static_cast<std::size_t>(options.plots)) {
    throw NothingToMeasure(
        "only " + std::to_string(canopy.size()) + " of the map's " + std::to_string(voxels) +
        " voxels lie in the searched area and more than " + format_number(options.min_height_m) +
        " m above its ground, too few for " + std::to_string(options.plots) +
        " plots; check the crop box, the minimum height and the number of plots");
  }
  return k_means(canopy,
                 {.clusters = options.plots, .seed = options.seed, .threads = options.threads});
}

// Each cluster flattened and boxed.
std::vector<PlotBox> cluster_boxes(const Cloud& canopy, const Clustering& clustering) {
  std::vector<std::vector<Eigen::Vector2d>> flat(clustering.centers.size());
  for (std::size_t i = 0; i < canopy.size(); ++i) {
    flat[clustering.cluster_of[i]].emplace_back(canopy[i].head<2>().cast<double>());
  }
  std::vector<PlotBox> boxes;
  for (std::vector<Eigen::Vector2d>& points : flat) {
    const PlotBox box = minimum_area_box(std::move(points));
    if (box.width_m > 0) boxes.push_back(box);
  }
  if (boxes.empty()) {
    throw NothingToMeasure("no cluster of the points above the ground has an area; " +
                           std::string("is the number of plots right?"));
  }
  return boxes;
}

// The plot's heading, width and length, each voted by the clusters' boxes.
PlotBox voted_box(const std::vector<PlotBox>& boxes, const Options& options,
                  estimate::Diagnostics& diagnostics) {
  const Vote heading =
      vote_heading(list_of(boxes, &PlotBox::heading_rad), options.orientation_bin_rad);
  const Vote width = vote(list_of(boxes, &PlotBox::width_m), options.width_bin_m);
  const Vote length = vote(list_of(boxes, &PlotBox::length_m), options.length_bin_m);
  diagnostics.of_method["votes"] = {{"clusters", boxes.size()},
                                    {"heading", heading.votes},
                                    {"width", width.votes},
                                    {"length", length.votes}};
  diagnostics.of_method["plot"] = {{"heading_deg", heading.value / kDegrees},
                                   {"width_m", width.value},
                                   {"length_m", length.value}};
  diagnostics.lines = {fmt::format("plot size  {:.2f} x {:.2f} m, heading {:.1f} deg", width.value,
                                   length.value, heading.value / kDegrees),
                       fmt::format("votes      of {} clusters: width {}, length {}, heading {}",
                                   boxes.size(), width.votes, length.votes, heading.votes)};
  return {.width_m = width.value, .length_m = length.value, .heading_rad = heading.value};
}

json to_json(const Lattice& lattice) {
  json document = {{"agreeing_clusters", lattice.agreeing}, {"rms_m", lattice.rms_m}};
  if (lattice.many_rows) document["row_step_m"] = lattice.steps.col(0).norm();
  if (lattice.many_columns) document["column_step_m"] = lattice.steps.col(1).norm();
  return document;
}

std::string line_of(const Lattice& lattice) {
  std::string pitch;
  if (lattice.many_columns)
    pitch += fmt::format(", {:.2f} m along the width", lattice.steps.col(1).norm());
  if (lattice.many_rows)
    pitch += fmt::format(", {:.2f} m along the length", lattice.steps.col(0).norm());
  return fmt::format("grid       {} clusters agree to {:.2f} m rms{}", lattice.agreeing,
                     lattice.rms_m, pitch);
}

// The lattice of a part of the field, carried on over all of it.
Lattice carried_on(const Lattice& lattice, const PlotBox& plot, const Cloud& canopy) {
  if (!lattice.many_rows || !lattice.many_columns) {
    throw InputError(
        "the plots in the learn box lie in one line, which tells nothing of the grid's other "
        "step; a learn box holds at least 2 x 2 plots");
  }
  return carried_over(lattice, plot, canopy);
}

// Section IV-B: the clusters and plots of the map in its own frame.
void find_plots(const cloud::CloudMap& map, const Cloud& voxels, const Options& options,
                estimate::Estimate& estimate) {
  json& said = estimate.diagnostics.of_method;
  const cloud::Area area = options.crop_box.value_or(map.area());
  const GroundLevel level =
      options.level ? fit_ground_level(voxels) : GroundLevel{.offset_m = -map.origin().z()};
  const Cloud canopy = inside(canopy_of(voxels, level, options.min_height_m), area, map.origin());
  const Cloud learnt =
      options.learn_box ? inside(canopy, *options.learn_box, map.origin()) : canopy;
  const Clustering clustering = cluster(learnt, voxels.size(), options);
  const std::vector<PlotBox> boxes = cluster_boxes(learnt, clustering);
  const PlotBox plot = voted_box(boxes, options, estimate.diagnostics);
  const std::vector<Eigen::Vector2d> centers = list_of(boxes, &PlotBox::center);
  std::optional<Lattice> lattice = fit_lattice(centers, plot);
  said["ground_level"] = {{"z_m", level.offset_m + map.origin().z()},
                          {"slope_x", level.slope.x()},
                          {"slope_y", level.slope.y()}};
  said["canopy_voxels"] = canopy.size();
  said["canopy_share"] = static_cast<double>(canopy.size()) / static_cast<double>(voxels.size());
  said["k_means"] = {{"inertia_m2", clustering.inertia_m2}, {"iterations", clustering.iterations}};
  if (!lattice)
    throw NothingToMeasure(
        "the clusters form no grid of plots; check the crop box and the number of plots");
  if (options.learn_box) lattice = carried_on(*lattice, plot, canopy);
  said["grid"] = to_json(*lattice);
  estimate.diagnostics.lines.push_back(line_of(*lattice));
  const std::size_t most = options.learn_box ? kMostPlots : options.plots;
  estimate.clusters = boxes;
  estimate.plots = fill_lattice(*lattice, plot, canopy, centers, options.voxel_m, most);
  if (estimate.plots.empty())
    throw NothingToMeasure(
        "no box of the grid holds canopy; check the crop box and the minimum height");
}

// From the map's frame to the cloud's.
void move_by(const Eigen::Vector3d& origin, estimate::Estimate& estimate) {
  for (PlotBox& box : estimate.clusters) box.center += origin.head<2>();
  for (estimate::PlotEstimate& plot : estimate.plots) {
    plot.box.center += origin.head<2>();
    if (plot.ground) plot.ground->z_m += origin.z();
  }
}

// The part of the cloud that is read; absent where the scanned field is to be found.
std::optional<cloud::NamedArea> area_of(const Options& options) {
  if (options.crop_box) return cloud::NamedArea{.area = *options.crop_box};
  if (options.boxes.empty()) return std::nullopt;
  std::vector<PlotBox> boxes = options.boxes;
  for (PlotBox& box : boxes) box = lengthened(box, options.extend_m);
  return cloud::NamedArea{.area = cloud::around(extent_of(boxes)), .name = "given boxes"};
}

bool reaches_out(const cloud::Area& inner, const cloud::Area& outer) {
  return !cloud::holds(outer, {inner[0], inner[1]}) || !cloud::holds(outer, {inner[2], inner[3]});
}

void require_count(int count, int most, const std::string& name) {
  if (count >= 1 && count <= most) return;
  throw InputError(name + " is " + std::to_string(count) + "; it is 1 to " + std::to_string(most));
}

}  // namespace

void require_sound(const Options& options) {
  if (options.boxes.empty()) {
    if (options.plots == 0) {
      throw InputError("the number of plots is not given, or 0; it is 1 to " +
                       std::to_string(kMostPlots) + ", unless the plots' boxes are given");
    }
    require_count(options.plots, kMostPlots, "the number of plots");
  } else if (options.learn_box) {
    throw InputError("a learn box and given boxes exclude each other");
  }
  if (options.crop_box) cloud::require_area(*options.crop_box, "crop box");
  if (options.learn_box) cloud::require_area(*options.learn_box, "learn box");
  if (options.learn_box && options.crop_box && reaches_out(*options.learn_box, *options.crop_box)) {
    throw InputError("the learn box reaches out of the crop box");
  }
  require_settings(settings(), options);
  require_count(options.threads, kMostThreads, "the number of threads");
}

estimate::Estimate estimate_plots(const cloud::CloudMap& map, const Options& options,
                                  const ProgressReport& progress) {
  require_sound(options);
  estimate::Estimate estimate{.method = "dhami2020"};
  const Cloud voxels = voxel_filter(map.points(), options.voxel_m);  // IV-A
  estimate.diagnostics.points = {
      .read = map.points_read() + map.not_given().not_finite + map.not_given().left_out,
      .in_area = map.points().size(),
      .unused = {{estimate::Unused::not_finite, map.not_given().not_finite},
                 {estimate::Unused::left_out, map.not_given().left_out},
                 {estimate::Unused::outside, map.points_read() - map.points().size()}},
      .area_m = map.area()};
  estimate.diagnostics.of_method["voxels"] = voxels.size();
  if (progress) progress(0.6);
  if (options.boxes.empty())
    find_plots(map, voxels, options, estimate);  // IV-B
  else
    estimate.plots = estimate::given_plots(options.boxes, map.origin());
  if (progress) progress(0.8);
  measure_heights(estimate.plots, map.points(), voxels, options);  // IV-C
  move_by(map.origin(), estimate);
  if (progress) progress(1);
  return estimate;
}

estimate::Estimate estimate_plots(const CloudFiles& cloud, const Options& options,
                                  const ProgressReport& progress) {
  require_sound(options);
  return estimate_plots(cloud::read_map(cloud, area_of(options), progress), options, progress);
}

}  // namespace plotscan::methods::dhami2020
