// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "core/progress.h"
#include "farm/farm.h"
#include "farm/surface_class.h"

namespace plotscan::farmfolder {

// Where a model's mesh lies in a farm folder: models/NAME/meshes/NAME.obj.
std::filesystem::path model_mesh_path(const std::string& name);
// The light mesh of a model that has one.
std::filesystem::path light_mesh_path(const std::string& name);

// Writes an SDF 1.6 world: a sun, the terrain (with collision), and one static model a plot with a
// visual for each plant (Gazebo loads thousands of separate models very slowly, and an <include>
// cannot be scaled). Each visual has its class as <laser_retro>. Mesh paths are relative to the
// file, as Gazebo Sim resolves them.
void write_world(const std::filesystem::path& path, const farm::Farm& farm, int threads,
                 const ProgressReport& progress);

// Writes model.config and model.sdf of one model below models_folder; its mesh is beside them. The
// ground has collision. The model is found as model://NAME through GZ_SIM_RESOURCE_PATH (Gazebo
// Classic: GAZEBO_MODEL_PATH).
void write_model_description(const std::filesystem::path& models_folder, const std::string& name,
                             const std::string& text, farm::SurfaceClass label);

}  // namespace plotscan::farmfolder
