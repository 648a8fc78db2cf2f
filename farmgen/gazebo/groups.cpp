// SPDX-License-Identifier: Apache-2.0
#include "gazebo/groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "sdfxml/elements.h"

#include "gazebo/internal/naming.h"

namespace plotscan::gazebo {
namespace {

using Plants = std::vector<const farm::Plant*>;

// The name, with the ending that sets weeds apart.
std::string classed(const std::string& name, SurfaceClass label) {
  return label == SurfaceClass::weed ? weeds_name(name) : name;
}

Eigen::Vector3d on_ground(const farm::Farm& farm, const Eigen::Vector2d& place,
                          const Plants& plants) {
  // Where the middle of the plants lies off the terrain, the first one's foot will do.
  const double z = farm.terrain.height(place.x(), place.y()).value_or(plants.front()->position.z());
  return {place.x(), place.y(), z};
}

struct PlantsByPlace {
  std::map<std::pair<std::size_t, SurfaceClass>, Plants> by_plot;  // index into farm.plots
  std::map<SurfaceClass, Plants> outside;
};

PlantsByPlace sorted_plants(const farm::Farm& farm) {
  std::unordered_map<std::uint32_t, std::size_t> index;
  for (std::size_t i = 0; i < farm.plots.size(); ++i) index[farm.plots[i].id] = i;
  PlantsByPlace sorted;
  for (const farm::Plant& plant : farm.plants) {
    const SurfaceClass label = class_of(plant.kind);
    const auto plot = index.find(plant.plot);
    Plants& plants =
        plot == index.end() ? sorted.outside[label] : sorted.by_plot[{plot->second, label}];
    plants.push_back(&plant);
  }
  return sorted;
}

PlantGroup plot_group(const farm::Farm& farm, const farm::Plot& plot, const Plants& plants) {
  return {.link = "link",
          .mesh_prefix = "",
          .origin = on_ground(farm, plot.box.center, plants),
          .heading_rad = plot.box.heading_rad,
          .plants = plants};
}

std::vector<PlantGroups> by_plot(const farm::Farm& farm, const PlantsByPlace& sorted) {
  std::vector<PlantGroups> models;
  for (const auto& [place, plants] : sorted.by_plot) {
    const farm::Plot& plot = farm.plots[place.first];
    PlantGroup group = plot_group(farm, plot, plants);
    models.push_back({.name = classed(sdfxml::plot_element_name(plot.id), place.second),
                      .label = place.second,
                      .origin = group.origin,
                      .links = {std::move(group)}});
  }
  return models;
}

std::vector<PlantGroups> by_row(const farm::Farm& farm, const PlantsByPlace& sorted) {
  std::map<std::tuple<int, int, SurfaceClass>, PlantGroups> rows;
  for (const auto& [place, plants] : sorted.by_plot) {
    const farm::Plot& plot = farm.plots[place.first];
    PlantGroup group = plot_group(farm, plot, plants);
    group.link = classed(sdfxml::plot_element_name(plot.id), place.second);
    group.mesh_prefix = group.link + "_";
    PlantGroups& row = rows[{plot.trial, plot.row, place.second}];
    if (row.links.empty()) {
      row.name = classed(row_model_name(plot.trial, plot.row), place.second);
      row.label = place.second;
      row.origin = group.origin;
    }
    row.links.push_back(std::move(group));
  }
  std::vector<PlantGroups> models;
  models.reserve(rows.size());
  for (auto& [key, row] : rows) models.push_back(std::move(row));
  return models;
}

void add_outside(const farm::Farm& farm, SurfaceClass label, const Plants& plants,
                 std::vector<PlantGroups>& models) {
  std::map<std::pair<double, double>, Plants> tiles;
  const bool many = plants.size() > kTilePlants;
  for (const farm::Plant* plant : plants) {
    const Eigen::Vector2d tile = (plant->position.head<2>() / kTile_m).array().floor();
    tiles[many ? std::pair(tile.y(), tile.x()) : std::pair(0.0, 0.0)].push_back(plant);
  }
  std::uint32_t number = 0;
  for (const auto& [tile, members] : tiles) {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const farm::Plant* plant : members) middle += plant->position.head<2>();
    middle /= static_cast<double>(members.size());
    PlantGroup group{.link = "link",
                     .mesh_prefix = "",
                     .origin = on_ground(farm, middle, members),
                     .heading_rad = 0,
                     .plants = members};
    const std::string name = many ? outside_model_name(++number) : sdfxml::kPlantsOutsidePlots;
    models.push_back({.name = classed(name, label),
                      .label = label,
                      .origin = group.origin,
                      .links = {std::move(group)}});
  }
}

}  // namespace

std::vector<PlantGroups> plant_groups(const farm::Farm& farm, Merge merge) {
  const PlantsByPlace sorted = sorted_plants(farm);
  std::vector<PlantGroups> models =
      merge == Merge::row ? by_row(farm, sorted) : by_plot(farm, sorted);
  for (const auto& [label, plants] : sorted.outside) add_outside(farm, label, plants, models);
  return models;
}

}  // namespace plotscan::gazebo
