// SPDX-License-Identifier: Apache-2.0
#include "farmfolder/internal/world_sdf.h"

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "core/list_of.h"
#include "farmfolder/internal/ordered_texts.h"
#include "farmfolder/internal/plant_visuals.h"
#include "sdfxml/elements.h"

namespace plotscan::farmfolder {
namespace {

constexpr const char* kSdfVersion = "1.6";

void write_one_mesh_model(sdfxml::XmlFile& xml, const std::string& name, const std::string& uri,
                          farm::SurfaceClass label) {
  sdfxml::open_static_model(xml, name);
  sdfxml::write_mesh_part(xml, "visual", "visual", uri, label);
  if (label == farm::SurfaceClass::ground)
    sdfxml::write_mesh_part(xml, "collision", "collision", uri, label);
  sdfxml::close_static_model(xml);
}

using PlantList = std::vector<const farm::Plant*>;

// Some plants of a plot's model, and whether they are its first and last ones.
struct PlantsPiece {
  std::uint32_t plot = 0;
  std::span<const farm::Plant* const> plants;
  bool first = false, last = false;
};

std::vector<PlantsPiece> pieces_of(const std::map<std::uint32_t, PlantList>& by_plot) {
  constexpr std::size_t kMostPlants = 1000;
  std::vector<PlantsPiece> pieces;
  for (const auto& [plot, list] : by_plot) {
    const std::span plants(list);
    for (std::size_t begin = 0; begin < plants.size(); begin += kMostPlants) {
      const std::size_t count = std::min(kMostPlants, plants.size() - begin);
      pieces.push_back({.plot = plot,
                        .plants = plants.subspan(begin, count),
                        .first = begin == 0,
                        .last = begin + count == plants.size()});
    }
  }
  return pieces;
}

// A static model a plot, and one for the plants of none.
void write_plants_by_plot(sdfxml::XmlFile& xml, const farm::Farm& farm, int threads,
                          const ProgressReport& progress) {
  constexpr int kOpenElements = 4;  // sdf, world, model, link
  const auto uris = list_of(farm.models, [](const farm::PlantModel& model) {
    return model_mesh_path(model.name).generic_string();
  });
  std::map<std::uint32_t, PlantList> by_plot;
  for (const farm::Plant& plant : farm.plants) by_plot[plant.plot].push_back(&plant);
  const std::vector<PlantsPiece> pieces = pieces_of(by_plot);
  const PlantVisuals visuals(uris, kOpenElements);
  const auto print = [&](std::size_t piece) {
    std::string text;
    for (const farm::Plant* plant : pieces[piece].plants) visuals.append(text, *plant);
    return text;
  };
  const auto write = [&](std::size_t number, const std::string& plants) {
    const PlantsPiece& piece = pieces[number];
    if (piece.first)
      sdfxml::open_static_model(xml, piece.plot == 0 ? sdfxml::kPlantsOutsidePlots
                                                     : sdfxml::plot_element_name(piece.plot));
    xml.append(plants);
    if (piece.last) sdfxml::close_static_model(xml);
    progress(static_cast<double>(number + 1) / static_cast<double>(pieces.size()));
  };
  make_in_order(pieces.size(), threads, print, write);
}

}  // namespace

std::filesystem::path model_mesh_path(const std::string& name) {
  return std::filesystem::path("models") / name / "meshes" / (name + ".obj");
}

std::filesystem::path light_mesh_path(const std::string& name) {
  return model_mesh_path(name).replace_filename(name + "_light.obj");
}

void write_world(const std::filesystem::path& path, const farm::Farm& farm, int threads,
                 const ProgressReport& progress) {
  sdfxml::XmlFile xml(path);
  xml.open("sdf");
  xml.attribute("version", kSdfVersion);
  xml.open("world", farm.name);
  sdfxml::write_sun(xml);
  write_one_mesh_model(xml, sdfxml::kTerrainModel,
                       model_mesh_path(sdfxml::kTerrainModel).generic_string(),
                       farm::SurfaceClass::ground);
  write_plants_by_plot(xml, farm, threads, progress);
  xml.close();
  xml.close();
  xml.finish();
}

void write_model_description(const std::filesystem::path& models_folder, const std::string& name,
                             const std::string& text, farm::SurfaceClass label) {
  sdfxml::write_model_config(models_folder / name / "model.config", name, kSdfVersion, text);
  sdfxml::XmlFile sdf(models_folder / name / "model.sdf");
  sdf.open("sdf");
  sdf.attribute("version", kSdfVersion);
  write_one_mesh_model(sdf, name, "model://" + name + "/meshes/" + name + ".obj", label);
  sdf.close();
  sdf.finish();
}

}  // namespace plotscan::farmfolder
