// SPDX-License-Identifier: Apache-2.0
#include <unordered_set>

#include "core/error.h"
#include "core/list_of.h"
#include "farm/true_heights.h"
#include "planting/internal/plants.h"
#include "planting/layout_table.h"
#include "planting/plot_layout.h"

namespace plotscan::planting {
std::vector<farm::Plant> table_plants(const LayoutDescription& layout,
                                      const std::vector<farm::Plot>& plots,
                                      const std::vector<farm::PlantModel>& models,
                                      const terrain::Terrain& terrain) {
  const std::vector<std::string> names = list_of(models, &farm::PlantModel::name);
  std::unordered_set<std::uint32_t> plot_ids = {0};
  for (const farm::Plot& plot : plots) plot_ids.insert(plot.id);
  const PlotFinder finder(plots);
  std::vector<farm::Plant> plants;
  for (const LayoutPlant& row : read_layout_table(layout.plants, layout.columns, names)) {
    const auto ground = terrain.height(row.position.x(), row.position.y());
    if (!ground) throw InputError(layout.plants, row.line, "the plant stands off the terrain");
    farm::Plant plant;
    plant.id = static_cast<std::uint32_t>(plants.size() + 1);
    plant.plot = row.plot ? *row.plot : finder.plot_at(row.position);
    if (!plot_ids.contains(plant.plot)) {
      throw InputError(layout.plants, row.line, "plot {} is not one of the farm's {} plots",
                       plant.plot, plots.size());
    }
    plant.model = row.model;
    plant.kind = row.kind;
    plant.position = {row.position.x(), row.position.y(), row.z_m.value_or(*ground)};
    plant.rotation = row.rotation;
    plant.scale = row.scale;
    plant.height_m = farm::placed_height(models[plant.model], plant, *ground);
    plants.push_back(plant);
  }
  return plants;
}

}  // namespace plotscan::planting
