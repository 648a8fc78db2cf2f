// SPDX-License-Identifier: Apache-2.0
#include "score/oracle_ground.h"

#include <optional>
#include <utility>

#include "cloud/points_in_boxes.h"
#include "core/statistics.h"
#include "methods/dhami2020/voxel_filter.h"

namespace plotscan::score {
namespace {

using Points = std::vector<Eigen::Vector3f>;

void append_heights(const Points& points, const Eigen::Vector3d& origin,
                    const terrain::Terrain& terrain, double tolerance_m,
                    std::vector<double>& heights_m) {
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d world = origin + point.cast<double>();
    const std::optional<double> ground_z = terrain.height(world.x(), world.y());
    if (ground_z && world.z() - *ground_z > tolerance_m) heights_m.push_back(world.z() - *ground_z);
  }
}

// In the map's own frame.
std::vector<PlotBox> extended_boxes(const std::vector<TruePlot>& plots,
                                    const Eigen::Vector3d& origin, double extend_m) {
  std::vector<PlotBox> boxes;
  for (const TruePlot& plot : plots) {
    boxes.push_back(lengthened(plot.box, extend_m));
    boxes.back().center -= origin.head<2>();
  }
  return boxes;
}

}  // namespace

estimate::Estimate oracle_ground(const cloud::CloudMap& map, const std::vector<TruePlot>& plots,
                                 const terrain::Terrain& terrain,
                                 const methods::dhami2020::Options& options) {
  const Points voxels = methods::dhami2020::voxel_filter(map.points(), options.voxel_m);
  const std::vector<PlotBox> boxes = extended_boxes(plots, map.origin(), options.extend_m);
  const std::vector<Points> raw_by_plot = cloud::points_in_boxes(map.points(), boxes);
  const std::vector<Points> voxels_by_plot = cloud::points_in_boxes(voxels, boxes);
  estimate::Estimate estimate{.method = "oracle-ground"};
  for (std::size_t i = 0; i < plots.size(); ++i) {
    std::vector<double> heights_m;
    for (const Points* points : {&raw_by_plot[i], &voxels_by_plot[i]}) {
      append_heights(*points, map.origin(), terrain, options.plane_tolerance_m, heights_m);
    }
    estimate.plots.push_back({.id = plots[i].id,
                              .row = plots[i].row,
                              .column = plots[i].column,
                              .box = plots[i].box,
                              .points = raw_by_plot[i].size()});
    if (!heights_m.empty())
      estimate.plots.back().heights_m["p99"] = quantile(std::move(heights_m), 0.99);
  }
  return estimate;
}

}  // namespace plotscan::score
