// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "farm/farm.h"
#include "gazebo/export_options.h"
#include "gazebo/groups.h"
#include "gazebo/plant_models.h"

namespace plotscan::gazebo {

// How a Gazebo calls its plugins.
enum class PluginNames {
  none,      // Gazebo Classic needs none
  gz,        // Gazebo Sim from Garden on
  ignition,  // Gazebo Sim Fortress, which knows no others
};

struct World {
  const farm::Farm& farm;
  const ExportOptions& options;
  const std::vector<PlantGroups>& groups;         // of the plants, when they are merged
  const std::vector<SinglePlant>& single_plants;  // their meshes by model, when they are not
};

// Writes the world: light, physics, plugins, the terrain, the plants and the drone. Returns what it
// holds besides the models it includes.
EntityCounts write_world(const std::filesystem::path& path, const World& world, PluginNames names);

// Duration of a physics step, seconds.
inline constexpr double kStep_s = 0.001;

}  // namespace plotscan::gazebo
