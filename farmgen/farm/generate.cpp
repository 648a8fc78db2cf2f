// SPDX-License-Identifier: Apache-2.0
#include "farm/generate.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "mesh/measure.h"

#include "core/error.h"
#include "core/statistics.h"
#include "farm/heights.h"
#include "farm/make_terrain.h"
#include "farm/plant_layout.h"
#include "farm/plot_layout.h"
#include "farm/plot_table.h"

namespace plotscan::farm {
namespace {

std::vector<PlantModel> import_models(const std::vector<ModelDescription>& descriptions) {
  std::vector<PlantModel> models;
  for (const ModelDescription& description : descriptions) {
    mesh::Mesh mesh = mesh::import_mesh(description.mesh, description.options);
    const double height_m = mesh::mesh_height(mesh);
    if (height_m <= 0) {
      throw InputError(description.mesh,
                       "has no vertex above its origin; is z its up axis? (up: y, foot: lowest)");
    }
    models.push_back({description.name, std::move(mesh), height_m});
  }
  return models;
}

std::vector<Plot> make_plots(const FarmDescription& description) {
  if (description.plots) return grid_plots(*description.plots);
  if (description.layout->plots) return read_plot_boxes(*description.layout->plots);
  return {};
}

std::vector<Plant> make_plants(const FarmDescription& description, const Farm& farm) {
  if (description.layout) {
    return table_plants(*description.layout, farm.plots, farm.models, farm.terrain);
  }
  return random_plants(*description.plants, farm.plots, farm.models, farm.terrain, farm.seed);
}

// How far the plant's stem leans from the vertical.
double lean_of(const Plant& plant) {
  return 2 * std::asin(std::min(1.0, std::hypot(plant.rotation.x(), plant.rotation.y())));
}

// Counts, heights and leans of each plot's plants; of the weeds, the count.
void measure_plots(Farm& farm) {
  std::unordered_map<std::uint32_t, std::vector<double>> heights;
  std::unordered_map<std::uint32_t, std::vector<double>> leans;
  std::unordered_map<std::uint32_t, std::uint32_t> weeds;
  for (const Plant& plant : farm.plants) {
    if (plant.kind == PlantKind::weed) {
      ++weeds[plant.plot];
    } else {
      heights[plant.plot].push_back(plant.height_m);
      leans[plant.plot].push_back(lean_of(plant));
    }
  }
  for (Plot& plot : farm.plots) {
    const std::vector<double>& own = heights[plot.id];
    plot.plant_count = static_cast<std::uint32_t>(own.size());
    plot.heights = plot_heights(own, farm.seed, plot.id);
    plot.weed_count = weeds[plot.id];
    if (!own.empty()) plot.lodging_rad = mean(leans[plot.id]);
  }
}

}  // namespace

Farm generate(const FarmDescription& description, std::uint64_t seed) {
  std::vector<Plot> plots = make_plots(description);
  MadeTerrain ground = make_terrain(description.terrain, plots, seed, description.source);
  Farm farm{.name = description.name,
            .seed = seed,
            .terrain = std::move(ground.terrain),
            .models = import_models(description.models),
            .plots = std::move(plots),
            .plants = {},
            .anchor = description.anchor,
            .terrain_origin_m = ground.origin_m};
  require_on_terrain(farm.plots, farm.terrain, description.source);
  farm.plants = make_plants(description, farm);
  measure_plots(farm);
  return farm;
}

}  // namespace plotscan::farm
