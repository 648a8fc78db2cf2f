// SPDX-License-Identifier: Apache-2.0
#include "farm/summary.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>

#include "core/extent.h"
#include "core/list_of.h"
#include "core/statistics.h"
#include "mesh/measure.h"
#include "terrain/extent.h"

namespace plotscan::farm {
namespace {

Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [least, greatest] = std::ranges::minmax(values);
  return {.min = least, .mean = mean(values), .max = greatest};
}

void summarise_terrain(const terrain::Terrain& terrain, FarmSummary& summary) {
  const Eigen::AlignedBox3d box = terrain::extent_of(terrain);
  summary.terrain_size_m = box.sizes().head<2>();
  summary.terrain_z_m = {box.min().z(), box.max().z()};
  summary.terrain_triangles = terrain.triangles().size();
}

double summarise_plots(const std::vector<Plot>& plots, FarmSummary& summary) {
  const Eigen::AlignedBox2d field = extent_of(plots, &Plot::box);
  double area_m2 = 0;
  std::vector<double> heights;
  std::set<int> trials;
  for (const Plot& plot : plots) {
    trials.insert(plot.trial);
    area_m2 += plot.box.area_m2();
    if (plot.plant_count > 0) heights.push_back(plot.heights.max);
  }
  summary.plots = plots.size();
  summary.trials = trials.size();
  if (!field.isEmpty()) summary.field_size_m = field.sizes();
  summary.plot_height_max_m = spread_of(heights);
  return area_m2;
}

// Sums of a cultivar's plots, which become means at the end.
struct CultivarSums {
  CultivarSummary summary;
  double area_m2 = 0;
  double leaves_m2 = 0;
  double heights_m = 0;
};

CultivarSummary summary_of(const CultivarSums& sums) {
  CultivarSummary summary = sums.summary;
  if (summary.plants > 0)
    summary.height_mean_m = sums.heights_m / static_cast<double>(summary.plants);
  summary.plants_per_m2 = static_cast<double>(summary.plants) / sums.area_m2;
  summary.leaf_area_index = sums.leaves_m2 / sums.area_m2;
  return summary;
}

// The leaves of each plot's crop, by plot id.
using PlotLeaves = std::unordered_map<std::uint32_t, double>;

std::vector<CultivarSummary> summarise_cultivars(const std::vector<Plot>& plots,
                                                 const PlotLeaves& leaves_m2) {
  std::map<std::pair<int, std::string>, CultivarSums> cultivars;
  for (const Plot& plot : plots) {
    CultivarSums& sums = cultivars[{plot.trial, plot.accession}];
    CultivarSummary& own = sums.summary;
    own.trial = plot.trial;
    own.name = plot.accession;
    ++own.plots;
    own.lodged_plots += plot.lodging_rad > kLodged_rad ? 1 : 0;
    own.plants += plot.plant_count;
    own.missing_plants += plot.missing_plants;
    own.weeds += plot.weed_count;
    own.height_max_m = std::max(own.height_max_m, plot.heights.max);
    sums.heights_m += plot.heights.mean * plot.plant_count;
    sums.area_m2 += plot.box.area_m2();
    const auto leaves = leaves_m2.find(plot.id);
    if (leaves != leaves_m2.end()) sums.leaves_m2 += leaves->second;
  }
  return list_of(cultivars, [](const auto& entry) { return summary_of(entry.second); });
}

}  // namespace

FarmSummary summarise(const Farm& farm) {
  FarmSummary summary;
  summarise_terrain(farm.terrain, summary);
  const double plots_m2 = summarise_plots(farm.plots, summary);
  summary.models = farm.models.size();
  const auto leaves = list_of(
      farm.models, [](const PlantModel& model) { return mesh::ScaledArea::of_leaves(model.mesh); });
  std::vector<double> heights;
  heights.reserve(farm.plants.size());
  PlotLeaves plot_leaves_m2;
  double leaves_m2 = 0;
  for (const Plant& plant : farm.plants) {
    summary.plant_triangles += farm.models[plant.model].mesh.triangles.size();
    if (plant.kind == PlantKind::weed) continue;
    heights.push_back(plant.height_m);
    if (plant.plot == 0) continue;
    const double area_m2 = leaves[plant.model].at(plant.scale);
    plot_leaves_m2[plant.plot] += area_m2;
    leaves_m2 += area_m2;
  }
  summary.plants = heights.size();
  summary.weeds = farm.plants.size() - heights.size();
  summary.plant_height_m = spread_of(heights);
  summary.leaf_area_index = plots_m2 > 0 ? leaves_m2 / plots_m2 : 0;
  summary.cultivars = summarise_cultivars(farm.plots, plot_leaves_m2);
  return summary;
}

}  // namespace plotscan::farm
