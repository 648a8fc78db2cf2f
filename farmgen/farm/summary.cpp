// SPDX-License-Identifier: Apache-2.0
#include "farm/summary.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

namespace plotscan::farm {
namespace {

Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  double total = 0;
  for (const double value : values) total += value;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return {.min = *least, .mean = total / static_cast<double>(values.size()), .max = *greatest};
}

void summarise_terrain(const Terrain& terrain, FarmSummary& summary) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : terrain.vertices()) box.extend(vertex);
  summary.terrain_size_m = box.sizes().head<2>();
  summary.terrain_z_m = {box.min().z(), box.max().z()};
  summary.terrain_triangles = terrain.triangles().size();
}

double summarise_plots(const std::vector<Plot>& plots, FarmSummary& summary) {
  Eigen::AlignedBox2d field;
  double area_m2 = 0;
  std::vector<double> heights;
  for (const Plot& plot : plots) {
    for (const Eigen::Vector2d& corner : plot.box.corners()) field.extend(corner);
    area_m2 += plot.box.area_m2();
    if (plot.plant_count > 0) heights.push_back(plot.heights.max);
  }
  summary.plots = plots.size();
  if (!field.isEmpty()) summary.field_size_m = field.sizes();
  summary.plot_height_max_m = spread_of(heights);
  return area_m2;
}

}  // namespace

double scaled_area(const Mesh& mesh, const Eigen::Vector3d& scale) {
  // The cross product of scaled edges is the cross product scaled by the other two axes.
  const Eigen::Vector3d factor(scale.y() * scale.z(), scale.z() * scale.x(), scale.x() * scale.y());
  double twice = 0;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[triangle[0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices[triangle[1]].cast<double>();
    const Eigen::Vector3d c = mesh.vertices[triangle[2]].cast<double>();
    twice += (b - a).cross(c - a).cwiseProduct(factor).norm();
  }
  return twice / 2;
}

FarmSummary summarise(const Farm& farm) {
  FarmSummary summary;
  summarise_terrain(farm.terrain, summary);
  const double plots_m2 = summarise_plots(farm.plots, summary);
  summary.models = farm.models.size();
  summary.plants = farm.plants.size();
  std::vector<double> heights;
  heights.reserve(farm.plants.size());
  double leaves_m2 = 0;
  for (const Plant& plant : farm.plants) {
    const Mesh& mesh = farm.models[plant.model].mesh;
    heights.push_back(plant.height_m);
    summary.plant_triangles += mesh.triangles.size();
    if (plant.plot != 0) leaves_m2 += scaled_area(mesh, plant.scale);
  }
  summary.plant_height_m = spread_of(heights);
  summary.leaf_area_index = plots_m2 > 0 ? leaves_m2 / plots_m2 : 0;
  return summary;
}

}  // namespace plotscan::farm
