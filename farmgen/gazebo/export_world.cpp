// SPDX-License-Identifier: Apache-2.0
#include "gazebo/export_world.h"

#include <optional>
#include <set>
#include <utility>

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "core/error.h"
#include "core/output_folder.h"
#include "gazebo/internal/world_file.h"
#include "sdfxml/elements.h"

namespace plotscan::gazebo {
namespace fs = std::filesystem;
namespace {

// Share of the time that is over when the meshes are written, for the progress bar.
constexpr double kMeshShare = 0.9;

// The names of model folders have to differ: a plant model may be called like a plot or the drone.
void require_different_names(const farm::Farm& farm, const std::vector<MergedModel>& merged,
                             bool drone) {
  std::set<std::string> taken = {sdfxml::kTerrainModel};
  if (drone) taken.insert(kDroneModel);
  for (const MergedModel& model : merged) taken.insert(model.name);
  for (const farm::PlantModel& model : farm.models) {
    if (!taken.insert(model.name).second) {
      throw InputError(fmt::format(
          "plant model \"{}\" is called as another model of the world; give it another `name`",
          model.name));
    }
  }
}

void require_possible(const ExportOptions& options) {
  if (options.lidar == Lidar::gpu) return;
  if (!options.drone) throw InputError("the lidar is the drone's: --lidar cpu needs --drone");
  if (options.gazebo == Gazebo::sim) {
    throw InputError(
        "Gazebo Sim has no lidar without a renderer: --lidar cpu needs --gazebo classic");
  }
  if (options.collision == Collision::none) {
    throw InputError(
        "the CPU's lidar sees collisions, and the plants have none: --lidar cpu needs "
        "--collision mesh, or box");
  }
}

EntityCounts write_worlds(const fs::path& folder, const World& world) {
  if (world.options.gazebo == Gazebo::classic)
    return write_world(folder / "world.sdf", world, PluginNames::none);
  write_world(folder / "world_fortress.sdf", world, PluginNames::ignition);
  return write_world(folder / "world.sdf", world, PluginNames::gz);
}

std::uint64_t folder_bytes(const fs::path& folder) {
  std::uint64_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

ExportSummary write_export(const fs::path& farm_folder, const farm::Farm& farm,
                           const fs::path& folder, const ExportOptions& options, Manifest origin,
                           const ProgressReport& progress) {
  progress(0);
  const std::vector<MergedModel> merged = options.merge == Merge::none
                                              ? std::vector<MergedModel>{}
                                              : merged_models(farm, options.merge);
  require_different_names(farm, merged, options.drone);
  OutputFolder output(folder, options.replace, origin.command, {{farm_folder}});
  const ModelFolder models{.path = output.path() / "models", .gazebo = options.gazebo};
  const PlantSurfaces surfaces = plant_surfaces(farm, options.lod);
  const ExportedPlants plants{models, farm, surfaces, options.collision};
  ExportSummary summary{.counts = write_terrain_model(models, farm), .plants = farm.plants.size()};
  summary.counts +=
      write_merged_plants(plants, merged, [&](double share) { progress(kMeshShare * share); });
  if (options.drone)
    summary.counts += write_drone_model(models, options.lidar, farm.anchor.has_value());
  const std::vector<SinglePlant> single_plants = write_single_plants(plants);
  summary.counts += write_worlds(
      output.path(),
      {.farm = farm, .options = options, .merged = merged, .single_plants = single_plants});
  fs::copy(farm_folder / "truth", output.path() / "truth", fs::copy_options::recursive);
  if (options.drone) write_fly_script(output.path() / "fly_drone.sh", farm.name, options.gazebo);
  write_readme(output.path() / "README.md", farm, options, summary.counts);
  origin.seed = farm.seed;
  origin.results = counts_json(summary.counts);
  origin.results.update(
      {{"name", farm.name}, {"plots", farm.plots.size()}, {"plants", farm.plants.size()}});
  write_manifest(output.path(), origin);
  summary.bytes = folder_bytes(output.path());
  output.commit();
  progress(1);
  return summary;
}

}  // namespace

ExportSummary export_world(const farm::Farm& farm, const fs::path& farm_folder,
                           const fs::path& folder, const ExportOptions& options, Manifest origin,
                           const ProgressReport& progress) {
  require_possible(options);
  std::optional<tbb::global_control> more_threads;
  if (options.threads > tbb::info::default_concurrency()) {
    more_threads.emplace(tbb::global_control::max_allowed_parallelism,
                         static_cast<std::size_t>(options.threads));
  }
  ExportSummary summary;
  tbb::task_arena(options.threads).execute([&] {
    summary = write_export(
        farm_folder, farm, folder, options, std::move(origin), progress ? progress : [](double) {});
  });
  return summary;
}

}  // namespace plotscan::gazebo
