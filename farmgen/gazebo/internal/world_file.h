// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "farm/farm.h"
#include "gazebo/export_options.h"
#include "gazebo/merged_models.h"
#include "gazebo/model_sdf.h"
#include "gazebo/plant_models.h"

// The files of an exported world besides its models of plants.
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
  const std::vector<MergedModel>& merged;         // the plants, when they are merged
  const std::vector<SinglePlant>& single_plants;  // their meshes by model, when they are not
};

// Writes the world: light, physics, plugins, the terrain, the plants and the drone. Returns what it
// holds besides the models it includes.
EntityCounts write_world(const std::filesystem::path& path, const World& world, PluginNames names);

// Duration of a physics step, seconds.
inline constexpr double kStep_s = 0.001;

inline constexpr const char* kDroneModel = "drone";

// Writes models/drone: a quadrotor that is moved from outside, with a VLP-16 at its origin mounted
// as lidarsim's (spin axis along x, azimuth 0 down), an IMU and, with `gps`, a GPS receiver. All of
// its body is nearer to the origin than the least range. Gazebo Sim: a static model, which the
// service set_pose moves. Gazebo Classic: kinematic, without gravity; fly_drone.sh makes it an
// actor.
EntityCounts write_drone_model(const ModelFolder& models, Lidar lidar, bool gps);

// Writes a POSIX shell script (with awk) that moves the drone of an open world along a scan's
// trajectory.csv, interpolated as lidarsim does, and lets Gazebo run for each pose so long that the
// lidar fires. Gazebo Sim: service set_pose; Classic: the drone as an <actor> along its waypoints.
void write_fly_script(const std::filesystem::path& path, const std::string& world, Gazebo gazebo);

// Writes the README.md of an exported world: how it is opened, and what is in it.
void write_readme(const std::filesystem::path& path, const farm::Farm& farm,
                  const ExportOptions& options, const EntityCounts& counts);

}  // namespace plotscan::gazebo
