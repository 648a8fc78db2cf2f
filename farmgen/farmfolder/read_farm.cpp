// SPDX-License-Identifier: Apache-2.0
#include "farmfolder/read_farm.h"

#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/error.h"
#include "core/manifest.h"
#include "core/place_json.h"
#include "farm/true_heights.h"
#include "farmfolder/internal/plant_table.h"
#include "farmfolder/internal/world_sdf.h"
#include "farmfolder/plot_table.h"
#include "farmfolder/terrain_ply.h"
#include "mesh/measure.h"
#include "mesh/mesh_import.h"

namespace plotscan::farmfolder {
namespace fs = std::filesystem;
namespace {

// What the manifest says of the farm besides its files.
struct FarmRecord {
  std::string name;
  std::uint64_t seed = 0;
  std::vector<std::string> models;
  std::vector<std::string> light_models;  // those of them with a light mesh
  std::size_t plots = 0;
  std::size_t plants = 0;
  std::optional<Anchor> anchor = {};
  std::optional<Eigen::Vector3d> terrain_origin_m = {};
  std::optional<double> soil_reflectance = {};
};

double share_of(const fs::path& folder, const nlohmann::json& value) {
  const auto share = value.get<double>();
  if (share >= 0 && share <= 1) return share;
  throw InputError(folder / "manifest.json",
                   "results.soil_reflectance is {}; it is to be in [0, 1]", value.dump());
}

FarmRecord read_record(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder, "no such farm folder");
  const nlohmann::json manifest = read_manifest(folder);
  try {
    const nlohmann::json& results = manifest.at("results");
    FarmRecord record{.name = results.at("name"),
                      .seed = manifest.at("seed"),
                      .models = results.at("models"),
                      .light_models = results.at("light_models"),
                      .plots = results.at("plots"),
                      .plants = results.at("plants")};
    if (results.contains("anchor")) record.anchor = anchor_from(results["anchor"]);
    if (results.contains("terrain_origin_m")) {
      const nlohmann::json& origin = results["terrain_origin_m"];
      record.terrain_origin_m = Eigen::Vector3d(
          origin.at(0).get<double>(), origin.at(1).get<double>(), origin.at(2).get<double>());
    }
    if (results.contains("soil_reflectance"))
      record.soil_reflectance = share_of(folder, results["soil_reflectance"]);
    return record;
  } catch (const nlohmann::json::exception&) {
    throw InputError(folder, "is no farm folder (its manifest.json is not farmgen generate's)");
  }
}

std::vector<farm::PlantModel> read_plant_models(const fs::path& folder, const FarmRecord& record) {
  const fs::path manifest = folder / "manifest.json";
  const std::set<std::string> with_light(record.light_models.begin(), record.light_models.end());
  std::vector<mesh::MeshFile> files;
  for (const std::string& name : record.models) {
    // A name that leads out of models/ is refused.
    path_inside(folder / "models", name, manifest);
    files.push_back({.path = path_inside(folder, model_mesh_path(name), manifest)});
    if (with_light.contains(name))
      files.push_back({.path = path_inside(folder, light_mesh_path(name), manifest)});
  }
  mesh::MeshReader meshes(std::move(files));
  std::vector<farm::PlantModel> models;
  for (const std::string& name : record.models) {
    mesh::Mesh mesh = meshes.next().mesh;
    const double height_m = mesh::mesh_height(mesh);
    models.push_back({name, std::move(mesh), height_m});
    if (with_light.contains(name)) models.back().light = meshes.next().mesh;
  }
  return models;
}

void require_count(const fs::path& file, const std::string& what, std::size_t found,
                   std::size_t expected) {
  if (found == expected) return;
  throw InputError(file, "has {} {}; the farm has {}", found, what, expected);
}

struct PlantCounts {
  std::size_t crop = 0;
  std::size_t weeds = 0;
};

// Plants name plots that exist, and as many of them as the plots say.
void require_consistent(const fs::path& truth, const farm::Farm& farm) {
  std::unordered_map<std::uint32_t, PlantCounts> counts;
  for (const farm::Plot& plot : farm.plots) counts[plot.id] = {};
  for (const farm::Plant& plant : farm.plants) {
    if (plant.plot == 0) continue;
    const auto count = counts.find(plant.plot);
    if (count == counts.end()) {
      throw InputError(truth / "plants.csv", "plant {} is in plot {}, which plots.geojson lacks",
                       plant.id, plant.plot);
    }
    ++(plant.kind == farm::PlantKind::weed ? count->second.weeds : count->second.crop);
  }
  for (const farm::Plot& plot : farm.plots) {
    const std::string of_plot = " of plot " + std::to_string(plot.id);
    require_count(truth / "plants.csv", "plants" + of_plot, counts.at(plot.id).crop,
                  plot.plant_count);
    require_count(truth / "plants.csv", "weeds" + of_plot, counts.at(plot.id).weeds,
                  plot.weed_count);
  }
}

}  // namespace

farm::Farm read_farm(const fs::path& folder) {
  const FarmRecord record = read_record(folder);
  const fs::path truth = folder / "truth";
  farm::Farm farm{.name = record.name,
                  .seed = record.seed,
                  .terrain = read_terrain(truth / "terrain.ply"),
                  .models = read_plant_models(folder, record),
                  .plots = read_plots(truth / "plots.geojson"),
                  .plants = {},
                  .anchor = record.anchor,
                  .terrain_origin_m = record.terrain_origin_m,
                  .soil_reflectance = record.soil_reflectance};
  farm.plants = read_plants(truth / "plants.csv", farm.models);
  require_count(truth / "plots.geojson", "plots", farm.plots.size(), record.plots);
  require_count(truth / "plants.csv", "plants", farm.plants.size(), record.plants);
  require_consistent(truth, farm);
  for (const char* part : {"truth", "models"}) require_unchanged(folder, part);
  return farm;
}

}  // namespace plotscan::farmfolder
