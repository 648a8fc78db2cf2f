// SPDX-License-Identifier: Apache-2.0
#include "farmfolder/write_farm.h"

#include "core/output_folder.h"
#include "core/place_json.h"
#include "core/stage.h"
#include "core/text_file.h"
#include "farm/surface_colours.h"
#include "farmfolder/internal/plant_table.h"
#include "farmfolder/internal/world_sdf.h"
#include "farmfolder/plot_table.h"
#include "farmfolder/terrain_ply.h"
#include "mesh/obj.h"
#include "sdfxml/elements.h"

namespace plotscan::farmfolder {
namespace fs = std::filesystem;
namespace {

// Shares of the time that are over once truth/ and world.sdf are written, for the progress bar.
constexpr double kTruthShare = 0.35;
constexpr double kWorldShare = 0.9;

// The mesh; surfaces without a material get one of the given name and colour.
mesh::Mesh coloured(mesh::Mesh mesh, const std::string& name, const Eigen::Vector3f& colour) {
  if (mesh.materials.empty()) mesh.materials.emplace_back();
  for (mesh::Material& material : mesh.materials) {
    if (!material.name.empty()) continue;
    material.name = name;
    material.colour = colour;
    material.texture.reset();
  }
  return mesh;
}

void write_model(const fs::path& folder, const std::string& name, const mesh::Mesh& mesh,
                 const std::string& text, farm::SurfaceClass label) {
  const fs::path path = folder / model_mesh_path(name);
  fs::create_directories(path.parent_path());
  mesh::write_obj(path, mesh);
  write_model_description(folder / "models", name, text, label);
}

void write_models(const fs::path& folder, const farm::Farm& farm) {
  mesh::Mesh ground = coloured(terrain::mesh_of(farm.terrain), "soil", farm::kSoilBrown);
  if (farm.soil_reflectance)
    ground.materials.front().reflectance = static_cast<float>(*farm.soil_reflectance);
  write_model(folder, sdfxml::kTerrainModel, ground, "Terrain of the farm " + farm.name,
              farm::SurfaceClass::ground);
  const std::vector<farm::SurfaceClass> classes = farm::classes_of_models(farm);
  for (std::size_t i = 0; i < farm.models.size(); ++i) {
    const farm::PlantModel& model = farm.models[i];
    write_model(folder, model.name, coloured(model.mesh, "plant", farm::kLeafGreen),
                "Plant of the farm " + farm.name + ", foot at the origin", classes[i]);
    if (!model.light) continue;
    mesh::write_obj(folder / light_mesh_path(model.name),
                    coloured(*model.light, "plant", farm::kLeafGreen));
  }
}

void write_truth(const fs::path& folder, const farm::Farm& farm, int threads) {
  fs::create_directories(folder);
  write_plots(folder / "plots.geojson", farm.plots);
  if (farm.anchor) write_plots_wgs84(folder / "plots_wgs84.geojson", farm.plots, *farm.anchor);
  write_trial_layout(folder / "plots.csv", farm.name, farm.plots);
  write_plants(folder / "plants.csv", farm, threads);
  write_terrain(folder / "terrain.ply", farm.terrain);
}

// As it is, paths in it too.
void keep_description(const fs::path& folder, const fs::path& description) {
  if (description.empty()) return;
  fs::create_directories(folder);
  write_text_file(folder / description.filename(), read_text(description));
}

nlohmann::json results_of(const farm::Farm& farm) {
  nlohmann::json models = nlohmann::json::array();
  nlohmann::json with_light = nlohmann::json::array();
  for (const farm::PlantModel& model : farm.models) {
    models.push_back(model.name);
    if (model.light) with_light.push_back(model.name);
  }
  nlohmann::json results = {{"name", farm.name},
                            {"models", models},
                            {"light_models", with_light},
                            {"plots", farm.plots.size()},
                            {"plants", farm.plants.size()}};
  if (farm.anchor) results["anchor"] = anchor_json(*farm.anchor);
  if (farm.terrain_origin_m)
    results["terrain_origin_m"] = {farm.terrain_origin_m->x(), farm.terrain_origin_m->y(),
                                   farm.terrain_origin_m->z()};
  if (farm.soil_reflectance) results["soil_reflectance"] = *farm.soil_reflectance;
  return results;
}

}  // namespace

void write_farm(const farm::Farm& farm, const fs::path& folder, Manifest origin,
                const WriteOptions& options, const ProgressReport& progress) {
  const Stage stage("writing");
  const auto report = [&](double share) {
    if (progress) progress(share);
  };
  report(0);
  OutputFolder output(folder, options.replace, origin.command, origin.inputs);
  write_models(output.path(), farm);
  write_truth(output.path() / "truth", farm, options.threads);
  keep_description(output.path() / "description", options.description);
  report(kTruthShare);
  write_world(output.path() / "world.sdf", farm, options.threads,
              [&](double share) { report(kTruthShare + (kWorldShare - kTruthShare) * share); });
  origin.seed = farm.seed;
  origin.results = results_of(farm);
  write_manifest(output.path(), origin);
  output.commit();
  report(1);
}

}  // namespace plotscan::farmfolder
