// SPDX-License-Identifier: Apache-2.0
#include "farmfolder/internal/world.h"

#include <map>
#include <vector>

#include "sdfxml/elements.h"

namespace plotscan::farmfolder {
namespace {

constexpr const char* kSdfVersion = "1.6";

void write_one_mesh_model(sdfxml::XmlFile& xml, const std::string& name, const std::string& uri,
                          farm::SurfaceClass label) {
  sdfxml::open_static_model(xml, name);
  xml.open("visual", "visual");
  sdfxml::write_mesh_geometry(xml, uri);
  sdfxml::write_class(xml, label);
  xml.close();
  if (label == farm::SurfaceClass::ground) {
    xml.open("collision", "collision");
    sdfxml::write_mesh_geometry(xml, uri);
    sdfxml::write_class(xml, label);
    xml.close();
  }
  sdfxml::close_static_model(xml);
}

void write_plant(sdfxml::XmlFile& xml, const farm::Plant& plant, const std::string& uri) {
  xml.open("visual", sdfxml::plant_element_name(plant.id));
  xml.text("pose", sdfxml::sdf_pose(plant.position, plant.rotation));
  sdfxml::write_mesh_geometry(xml, uri, plant.scale);
  sdfxml::write_class(xml, farm::class_of(plant.kind));
  xml.close();
}

void write_plants_by_plot(sdfxml::XmlFile& xml, const farm::Farm& farm,
                          const ProgressReport& progress) {
  std::vector<std::string> uris;
  for (const farm::PlantModel& model : farm.models) {
    uris.push_back(model_mesh_path(model.name).generic_string());
  }
  std::map<std::uint32_t, std::vector<const farm::Plant*>> by_plot;
  for (const farm::Plant& plant : farm.plants) by_plot[plant.plot].push_back(&plant);
  std::size_t written = 0;
  for (const auto& [plot, plants] : by_plot) {
    sdfxml::open_static_model(
        xml, plot == 0 ? sdfxml::kPlantsOutsidePlots : sdfxml::plot_element_name(plot));
    for (const farm::Plant* plant : plants) write_plant(xml, *plant, uris[plant->model]);
    sdfxml::close_static_model(xml);
    written += plants.size();
    progress(static_cast<double>(written) / static_cast<double>(farm.plants.size()));
  }
}

}  // namespace

std::filesystem::path model_mesh_path(const std::string& name) {
  return std::filesystem::path("models") / name / "meshes" / (name + ".obj");
}

std::filesystem::path light_mesh_path(const std::string& name) {
  return model_mesh_path(name).replace_filename(name + "_light.obj");
}

void write_world(const std::filesystem::path& path, const farm::Farm& farm,
                 const ProgressReport& progress) {
  sdfxml::XmlFile xml(path);
  xml.open("sdf");
  xml.attribute("version", kSdfVersion);
  xml.open("world", farm.name);
  sdfxml::write_sun(xml);
  write_one_mesh_model(xml, sdfxml::kTerrainModel,
                       model_mesh_path(sdfxml::kTerrainModel).generic_string(),
                       farm::SurfaceClass::ground);
  write_plants_by_plot(xml, farm, progress);
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
