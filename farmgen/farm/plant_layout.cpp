// SPDX-License-Identifier: Apache-2.0
#include "farm/plant_layout.h"

#include <algorithm>
#include <numbers>
#include <unordered_set>

#include "core/error.h"
#include "core/random.h"
#include "farm/heights.h"
#include "farm/layout_table.h"
#include "farm/plot_layout.h"

namespace plotscan::farm {
namespace {

// Where the plant stands in its box: (along length, along width) from the centre.
Eigen::Vector2d random_place(const PlotBox& box, std::uint32_t id, std::uint64_t seed) {
  RandomStream random(seed, random_purpose("plant/position"), id);
  const double along_length = random.uniform(-0.5, 0.5) * box.length_m;
  return {along_length, random.uniform(-0.5, 0.5) * box.width_m};
}

// Plants fill the rows evenly (the first rows take what is left over), each row's plants evenly
// spaced; the jitter keeps them inside the box.
Eigen::Vector2d drilled_place(const PlantsDescription& description, const PlotBox& box,
                              std::uint32_t index, std::uint32_t id, std::uint64_t seed) {
  const std::uint32_t rows = description.drill_rows;
  const std::uint32_t row = index % rows;
  const std::uint32_t in_row = (description.count - row + rows - 1) / rows;
  const std::uint32_t place_in_row = index / rows;
  const Eigen::Vector2d even(((place_in_row + 0.5) / in_row - 0.5) * box.length_m,
                             ((row + 0.5) / rows - 0.5) * box.width_m);
  RandomStream random(seed, random_purpose("plant/jitter"), id);
  const double along_length = random.uniform(-description.jitter_m, description.jitter_m);
  const double along_width = random.uniform(-description.jitter_m, description.jitter_m);
  const Eigen::Vector2d half(box.length_m / 2, box.width_m / 2);
  return (even + Eigen::Vector2d(along_length, along_width)).cwiseMax(-half).cwiseMin(half);
}

Plant drawn_plant(const PlantsDescription& description, const std::vector<PlantModel>& models,
                  std::uint32_t id, std::uint64_t seed) {
  Plant plant;
  plant.id = id;
  plant.model = static_cast<std::uint32_t>(
      RandomStream(seed, random_purpose("plant/model"), id).below(models.size()));
  const double yaw =
      RandomStream(seed, random_purpose("plant/yaw"), id).uniform(0, 2 * std::numbers::pi);
  plant.rotation = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  RandomStream scale(seed, random_purpose("plant/scale"), id);
  for (int axis = 0; axis < 3; ++axis) {
    plant.scale[axis] = scale.uniform(description.min_scale, description.max_scale);
  }
  return plant;
}

}  // namespace

std::vector<Plant> random_plants(const PlantsDescription& description,
                                 const std::vector<Plot>& plots,
                                 const std::vector<PlantModel>& models, const Terrain& terrain,
                                 std::uint64_t seed) {
  std::vector<Plant> plants;
  plants.reserve(plots.size() * description.count);
  for (const Plot& plot : plots) {
    for (std::uint32_t index = 0; index < description.count; ++index) {
      const auto id = static_cast<std::uint32_t>(plants.size() + 1);
      Plant plant = drawn_plant(description, models, id, seed);
      plant.plot = plot.id;
      const Eigen::Vector2d place = description.pattern == PlantPattern::drilled
                                        ? drilled_place(description, plot.box, index, id, seed)
                                        : random_place(plot.box, id, seed);
      const Eigen::Vector2d world =
          plot.box.center + place.x() * plot.box.length_axis() + place.y() * plot.box.width_axis();
      const auto ground = terrain.height(world.x(), world.y());
      if (!ground) {
        throw InputError("plots: plot " + std::to_string(plot.id) +
                         " lies over a hole of the terrain");
      }
      plant.position = {world.x(), world.y(), *ground};
      plant.height_m = placed_height(models[plant.model], plant, *ground);
      plants.push_back(plant);
    }
  }
  return plants;
}

std::vector<Plant> table_plants(const LayoutDescription& layout, const std::vector<Plot>& plots,
                                const std::vector<PlantModel>& models, const Terrain& terrain) {
  std::vector<std::string> names;
  names.reserve(models.size());
  for (const PlantModel& model : models) names.push_back(model.name);
  std::unordered_set<std::uint32_t> plot_ids = {0};
  for (const Plot& plot : plots) plot_ids.insert(plot.id);
  const PlotFinder finder(plots);
  std::vector<Plant> plants;
  for (const LayoutPlant& row : read_layout_table(layout.plants, layout.columns, names)) {
    const auto ground = terrain.height(row.position.x(), row.position.y());
    if (!ground) throw InputError(layout.plants, row.line, "the plant stands off the terrain");
    Plant plant;
    plant.id = static_cast<std::uint32_t>(plants.size() + 1);
    plant.plot = row.plot ? *row.plot : finder.plot_at(row.position);
    if (!plot_ids.contains(plant.plot)) {
      throw InputError(layout.plants, row.line,
                       "plot " + std::to_string(plant.plot) + " is not one of the farm's " +
                           std::to_string(plots.size()) + " plots");
    }
    plant.model = row.model;
    plant.position = {row.position.x(), row.position.y(), row.z_m.value_or(*ground)};
    plant.rotation = row.rotation;
    plant.scale = row.scale;
    plant.height_m = placed_height(models[plant.model], plant, *ground);
    plants.push_back(plant);
  }
  return plants;
}

}  // namespace plotscan::farm
