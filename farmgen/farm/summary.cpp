// SPDX-License-Identifier: Apache-2.0
#include "farm/summary.h"

#include <algorithm>
#include <vector>

#include "mesh/measure.h"
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

FarmSummary summarise(const Farm& farm) {
  FarmSummary summary;
  summarise_terrain(farm.terrain, summary);
  const double plots_m2 = summarise_plots(farm.plots, summary);
  summary.models = farm.models.size();
  summary.plants = farm.plants.size();
  std::vector<mesh::ScaledArea> leaves;
  for (const PlantModel& model : farm.models) {
    leaves.push_back(mesh::ScaledArea::of_leaves(model.mesh));
  }
  std::vector<double> heights;
  heights.reserve(farm.plants.size());
  double leaves_m2 = 0;
  for (const Plant& plant : farm.plants) {
    heights.push_back(plant.height_m);
    summary.plant_triangles += farm.models[plant.model].mesh.triangles.size();
    if (plant.plot != 0) leaves_m2 += leaves[plant.model].at(plant.scale);
  }
  summary.plant_height_m = spread_of(heights);
  summary.leaf_area_index = plots_m2 > 0 ? leaves_m2 / plots_m2 : 0;
  return summary;
}

}  // namespace plotscan::farm
