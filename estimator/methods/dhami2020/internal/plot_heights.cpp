// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/internal/plot_heights.h"

#include <algorithm>
#include <optional>

#include "cloud/points_in_boxes.h"
#include "core/each_index.h"
#include "core/list_of.h"
#include "core/statistics.h"
#include "methods/dhami2020/ground_plane.h"

namespace plotscan::methods::dhami2020 {
namespace {

using Points = std::span<const Eigen::Vector3f>;

std::vector<Eigen::Vector3d> in_double(const std::vector<Eigen::Vector3f>& points) {
  return list_of<Eigen::Vector3d>(
      points, [](const Eigen::Vector3f& point) { return point.cast<double>(); });
}

void append_heights(const std::vector<Eigen::Vector3f>& points, const GroundPlane& ground,
                    double tolerance_m, std::vector<double>& heights_m) {
  for (const Eigen::Vector3f& point : points) {
    const double height_m = ground.height_of(point.cast<double>());
    if (height_m > tolerance_m) heights_m.push_back(height_m);
  }
}

// The plane as z over x and y; absent where it stands upright.
std::optional<estimate::PlotGround> plot_ground(const GroundPlane& plane, const PlotBox& box,
                                                double tolerance_m) {
  constexpr double kLeastUp = 1e-6;
  if (plane.normal.z() < kLeastUp) return std::nullopt;
  const Eigen::Vector2d slope = -plane.normal.head<2>() / plane.normal.z();
  return estimate::PlotGround{
      .z_m = plane.centroid.z() + slope.dot(box.center - plane.centroid.head<2>()),
      .slope = slope,
      .tolerance_m = tolerance_m};
}

void measure_plot(estimate::PlotEstimate& plot, const std::vector<Eigen::Vector3f>& raw,
                  const std::vector<Eigen::Vector3f>& voxels, double tolerance_m) {
  plot.points = raw.size();
  const std::optional<GroundPlane> ground = find_ground_plane(in_double(voxels), tolerance_m);
  if (!ground) return;
  plot.ground = plot_ground(*ground, plot.box, tolerance_m);
  std::vector<double> heights_m;
  append_heights(voxels, *ground, tolerance_m, heights_m);
  if (!heights_m.empty()) plot.heights_m["voxel-max"] = std::ranges::max(heights_m);
  append_heights(raw, *ground, tolerance_m, heights_m);
  if (heights_m.empty()) return;
  plot.heights_m["raw-max"] = std::ranges::max(heights_m);
  plot.heights_m["raw-p99"] = quantile(std::move(heights_m), 0.99);
}

}  // namespace

void measure_heights(std::vector<estimate::PlotEstimate>& plots, Points raw, Points voxels,
                     const Options& options) {
  const std::vector<PlotBox> boxes =
      list_of(plots, [&](const auto& plot) { return lengthened(plot.box, options.extend_m); });
  const auto raw_by_plot = cloud::points_in_boxes(raw, boxes);
  const auto voxels_by_plot = cloud::points_in_boxes(voxels, boxes);
  for_each_index(plots.size(), options.threads, [&](std::size_t i) {
    measure_plot(plots[i], raw_by_plot[i], voxels_by_plot[i], options.plane_tolerance_m);
  });
}

}  // namespace plotscan::methods::dhami2020
