// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/manifest.h"
#include "core/progress.h"
#include "gazebo/export_options.h"
#include "gazebo/plant_models.h"

namespace plotscan::gazebo {

struct ExportSummary {
  EntityCounts counts;  // of the world, the terrain and the drone with it
  std::uint64_t plants = 0;
  std::uint64_t bytes = 0;  // of the folder
};

// Writes a farm as a Gazebo world (docs/gazebo.md): world.sdf, models/, truth/, README.md,
// manifest.json; for Gazebo Sim world_fortress.sdf, with the drone fly_drone.sh. The folder appears
// whole or not at all, and holds the same bytes for any number of threads. The truth is
// copied from the farm's folder. Throws InputError when a plant model is called as another model of
// the world, Lidar::cpu is asked for without the drone, without collisions or for Gazebo Sim, or
// `folder` exists and options.replace does not cover it.
ExportSummary export_world(const farm::Farm& farm, const std::filesystem::path& farm_folder,
                           const std::filesystem::path& folder, const ExportOptions& options,
                           Manifest origin, const ProgressReport& progress = {});

}  // namespace plotscan::gazebo
