// SPDX-License-Identifier: Apache-2.0
#include "ground_methods.h"

#include <map>
#include <memory>

#include <pcl/point_types.h>
#include <pcl/segmentation/progressive_morphological_filter.h>

#include "cloud/points_in_boxes.h"
#include "core/extent.h"
#include "core/list_of.h"
#include "core/statistics.h"
#include "fieldmethod/ground_raster.h"
#include "ground/surface.h"
#include "methods/dhami2020/ground_plane.h"
#include "methods/dhami2020/voxel_filter.h"

namespace plotscan::ground_error {
namespace {

using Points = std::span<const Eigen::Vector3f>;
using Boxes = std::vector<PlotBox>;

std::vector<PlotGround> planes(Points points, const Boxes& boxes) {
  constexpr double kVoxel_m = 0.05, kExtend_m = 0.5, kTolerance_m = 0.05;  // the authors' settings
  Boxes longer = boxes;
  for (PlotBox& box : longer) box = lengthened(box, kExtend_m);
  const std::vector<Eigen::Vector3f> voxels = methods::dhami2020::voxel_filter(points, kVoxel_m);
  std::vector<PlotGround> grounds;
  for (const std::vector<Eigen::Vector3f>& inside : cloud::points_in_boxes(voxels, longer)) {
    const std::vector<Eigen::Vector3d> of_plot = list_of<Eigen::Vector3d>(
        inside, [](const Eigen::Vector3f& point) { return point.cast<double>(); });
    const auto plane = methods::dhami2020::find_ground_plane(of_plot, kTolerance_m);
    grounds.push_back({.height = [plane](const Eigen::Vector2d& place) {
      if (!plane) return kNaN;
      const Eigen::Vector2d off = place - plane->centroid.head<2>();
      return plane->centroid.z() - plane->normal.head<2>().dot(off) / plane->normal.z();
    }});
  }
  return grounds;
}

// The lowest point of each cell, in the rectangle about the plots.
pcl::PointCloud<pcl::PointXYZ>::Ptr lowest_points(Points points, const Eigen::Array2d& low,
                                                  const Eigen::Array2d& high, double cell_m) {
  std::map<std::pair<int, int>, Eigen::Vector3f> lowest;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Array2d place = point.head<2>().cast<double>().array();
    if ((place < low).any() || (place > high).any()) continue;
    const Eigen::Array2d cell = (place - low) / cell_m;
    const auto [entry, added] =
        lowest.try_emplace({static_cast<int>(cell.x()), static_cast<int>(cell.y())}, point);
    if (!added && point.z() < entry->second.z()) entry->second = point;
  }
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const auto& [cell, point] : lowest) cloud->push_back({point.x(), point.y(), point.z()});
  return cloud;
}

std::vector<PlotGround> morphological(Points points, const Boxes& boxes) {
  constexpr double kAround_m = 2, kThin_m = 0.1, kCell_m = 0.2;
  const Eigen::AlignedBox2d extent = extent_of(boxes);
  const Eigen::Array2d low = extent.min().array() - kAround_m;
  const Eigen::Array2d high = extent.max().array() + kAround_m;
  const auto cloud = lowest_points(points, low, high, kThin_m);
  pcl::ProgressiveMorphologicalFilter<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setCellSize(static_cast<float>(kCell_m));
  filter.setMaxWindowSize(3);  // metres: wider than a plot, so that alleys lie in every window
  filter.setSlope(0.5f);
  filter.setInitialDistance(0.1f);
  filter.setMaxDistance(0.3f);
  pcl::Indices ground;
  filter.extract(ground);
  const auto raster = std::make_shared<const fieldmethod::GroundRaster>(
      pcl::PointCloud<pcl::PointXYZ>(*cloud, ground), kCell_m);
  return std::vector<PlotGround>(boxes.size(), {.height = [raster](const Eigen::Vector2d& place) {
                                   return raster->z_m(place.x(), place.y());
                                 }});
}

std::vector<PlotGround> surface(Points points, const Boxes& boxes, int threads) {
  ground::SurfaceOptions options;
  options.threads = threads;
  const auto fitted = std::make_shared<const ground::Surface>(ground::fit_surface(points, options));
  return list_of(boxes, [&](const PlotBox& box) {
    return PlotGround{.height = [fitted](const Eigen::Vector2d& p) { return fitted->height(p); },
                      .standard_error_m = fitted->mean_standard_error(box)};
  });
}

}  // namespace

std::vector<Method> methods(int threads) {
  return {{"plane", planes},
          {"pmf", morphological},
          {"surface", [threads](Points points, const Boxes& boxes) {
             return surface(points, boxes, threads);
           }}};
}

}  // namespace plotscan::ground_error
