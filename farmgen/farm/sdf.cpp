// SPDX-License-Identifier: Apache-2.0
#include "farm/sdf.h"

#include <map>
#include <vector>

#include "farm/sdf_elements.h"

namespace plotscan::farm {
namespace {

constexpr const char* kSdfVersion = "1.6";

void write_one_mesh_model(XmlFile& xml, const std::string& name, const std::string& uri,
                          SurfaceClass label) {
  open_static_model(xml, name);
  xml.open("visual", "visual");
  write_mesh_geometry(xml, uri);
  write_class(xml, label);
  xml.close();
  if (label == SurfaceClass::ground) {
    xml.open("collision", "collision");
    write_mesh_geometry(xml, uri);
    write_class(xml, label);
    xml.close();
  }
  close_static_model(xml);
}

void write_plant(XmlFile& xml, const Plant& plant, const std::string& uri) {
  xml.open("visual", plant_element_name(plant.id));
  xml.text("pose", sdf_pose(plant.position, plant.rotation));
  write_mesh_geometry(xml, uri, plant.scale);
  write_class(xml, class_of(plant.kind));
  xml.close();
}

void write_plants_by_plot(XmlFile& xml, const Farm& farm, const ProgressReport& progress) {
  std::vector<std::string> uris;
  for (const PlantModel& model : farm.models) {
    uris.push_back(model_mesh_path(model.name).generic_string());
  }
  std::map<std::uint32_t, std::vector<const Plant*>> by_plot;
  for (const Plant& plant : farm.plants) by_plot[plant.plot].push_back(&plant);
  std::size_t written = 0;
  for (const auto& [plot, plants] : by_plot) {
    open_static_model(xml, plot == 0 ? kPlantsOutsidePlots : plot_element_name(plot));
    for (const Plant* plant : plants) write_plant(xml, *plant, uris[plant->model]);
    close_static_model(xml);
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

void write_world(const std::filesystem::path& path, const Farm& farm,
                 const ProgressReport& progress) {
  XmlFile xml(path);
  xml.open("sdf");
  xml.attribute("version", kSdfVersion);
  xml.open("world", farm.name);
  write_sun(xml);
  write_one_mesh_model(xml, kTerrainModel, model_mesh_path(kTerrainModel).generic_string(),
                       SurfaceClass::ground);
  write_plants_by_plot(xml, farm, progress);
  xml.close();
  xml.close();
  xml.finish();
}

void write_model_description(const std::filesystem::path& models_folder, const std::string& name,
                             const std::string& text, SurfaceClass label) {
  write_model_config(models_folder / name / "model.config", name, kSdfVersion, text);
  XmlFile sdf(models_folder / name / "model.sdf");
  sdf.open("sdf");
  sdf.attribute("version", kSdfVersion);
  write_one_mesh_model(sdf, name, "model://" + name + "/meshes/" + name + ".obj", label);
  sdf.close();
  sdf.finish();
}

}  // namespace plotscan::farm
