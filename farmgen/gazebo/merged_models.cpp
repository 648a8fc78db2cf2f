// SPDX-License-Identifier: Apache-2.0
#include "gazebo/merged_models.h"

#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "gazebo/internal/naming.h"
#include "sdfxml/elements.h"

namespace plotscan::gazebo {
namespace {

using Plants = std::vector<const farm::Plant*>;

// The name, with the ending that sets weeds apart.
std::string classed(const std::string& name, farm::SurfaceClass label) {
  return label == farm::SurfaceClass::weed ? weeds_name(name) : name;
}

Eigen::Vector3d on_ground(const farm::Farm& farm, const Eigen::Vector2d& place,
                          const Plants& plants) {
  // Where the middle of the plants lies off the terrain, the first one's foot will do.
  const double z = farm.terrain.height(place.x(), place.y()).value_or(plants.front()->position.z());
  return {place.x(), place.y(), z};
}

struct PlantsByPlace {
  std::map<std::pair<std::size_t, farm::SurfaceClass>, Plants> by_plot;  // index into farm.plots
  std::map<farm::SurfaceClass, Plants> outside;
};

PlantsByPlace sorted_plants(const farm::Farm& farm) {
  std::unordered_map<std::uint32_t, std::size_t> index;
  for (std::size_t i = 0; i < farm.plots.size(); ++i) index[farm.plots[i].id] = i;
  PlantsByPlace sorted;
  for (const farm::Plant& plant : farm.plants) {
    const farm::SurfaceClass label = farm::class_of(plant.kind);
    const auto plot = index.find(plant.plot);
    Plants& plants =
        plot == index.end() ? sorted.outside[label] : sorted.by_plot[{plot->second, label}];
    plants.push_back(&plant);
  }
  return sorted;
}

MergedLink plot_link(const farm::Farm& farm, const farm::Plot& plot, const Plants& plants) {
  return {.origin = on_ground(farm, plot.box.center, plants),
          .heading_rad = plot.box.heading_rad,
          .plants = plants};
}

// A model that begins with one link and stands where that does.
MergedModel model_of(const std::string& name, farm::SurfaceClass label, MergedLink link) {
  const Eigen::Vector3d origin = link.origin;
  return {
      .name = classed(name, label), .label = label, .origin = origin, .links = {std::move(link)}};
}

std::vector<MergedModel> by_plot(const farm::Farm& farm, const PlantsByPlace& sorted) {
  std::vector<MergedModel> models;
  for (const auto& [place, plants] : sorted.by_plot) {
    const farm::Plot& plot = farm.plots[place.first];
    models.push_back(
        model_of(sdfxml::plot_element_name(plot.id), place.second, plot_link(farm, plot, plants)));
  }
  return models;
}

std::vector<MergedModel> by_row(const farm::Farm& farm, const PlantsByPlace& sorted) {
  std::map<std::tuple<int, int, farm::SurfaceClass>, MergedModel> rows;
  for (const auto& [place, plants] : sorted.by_plot) {
    const farm::Plot& plot = farm.plots[place.first];
    MergedLink link = plot_link(farm, plot, plants);
    link.name = classed(sdfxml::plot_element_name(plot.id), place.second);
    link.mesh_prefix = link.name + "_";
    MergedModel& row = rows[{plot.trial, plot.row, place.second}];
    if (row.links.empty())
      row = model_of(row_model_name(plot.trial, plot.row), place.second, std::move(link));
    else
      row.links.push_back(std::move(link));
  }
  std::vector<MergedModel> models;
  models.reserve(rows.size());
  for (auto& [key, row] : rows) models.push_back(std::move(row));
  return models;
}

void add_outside(const farm::Farm& farm, farm::SurfaceClass label, const Plants& plants,
                 std::vector<MergedModel>& models) {
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

std::vector<MergedModel> merged_models(const farm::Farm& farm, Merge merge) {
  const PlantsByPlace sorted = sorted_plants(farm);
  std::vector<MergedModel> models =
      merge == Merge::row ? by_row(farm, sorted) : by_plot(farm, sorted);
  for (const auto& [label, plants] : sorted.outside) add_outside(farm, label, plants, models);
  return models;
}

}  // namespace plotscan::gazebo
