// SPDX-License-Identifier: Apache-2.0
#include "gazebo/groups.h"

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
  return {.origin = on_ground(farm, plot.box.center, plants),
          .heading_rad = plot.box.heading_rad,
          .plants = plants};
}

// A model that begins with one link and stands where that does.
PlantGroups model_of(const std::string& name, SurfaceClass label, PlantGroup link) {
  const Eigen::Vector3d origin = link.origin;
  return {
      .name = classed(name, label), .label = label, .origin = origin, .links = {std::move(link)}};
}

std::vector<PlantGroups> by_plot(const farm::Farm& farm, const PlantsByPlace& sorted) {
  std::vector<PlantGroups> models;
  for (const auto& [place, plants] : sorted.by_plot) {
    const farm::Plot& plot = farm.plots[place.first];
    models.push_back(
        model_of(sdfxml::plot_element_name(plot.id), place.second, plot_group(farm, plot, plants)));
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
    if (row.links.empty())
      row = model_of(row_model_name(plot.trial, plot.row), place.second, std::move(group));
    else
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
    const std::string name = many ? outside_model_name(++number) : sdfxml::kPlantsOutsidePlots;
    models.push_back(
        model_of(name, label, {.origin = on_ground(farm, middle, members), .plants = members}));
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
