// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/progress.h"
#include "farm/farm.h"
#include "gazebo/export_options.h"
#include "gazebo/merged_models.h"
#include "gazebo/model_sdf.h"
#include "gazebo/plant_surfaces.h"

namespace plotscan::gazebo {

// What a world consists of.
struct EntityCounts {
  std::uint64_t models = 0;
  std::uint64_t links = 0;
  std::uint64_t visuals = 0;
  std::uint64_t collisions = 0;
  std::uint64_t triangles = 0;  // of all visuals

  EntityCounts& operator+=(const EntityCounts& other);
};

// The counts as manifests hold them and --json prints them.
nlohmann::json counts_json(const EntityCounts& counts);

// What a world that is made of single plants has to know of a plant's mesh.
struct SinglePlant {
  std::string uri;
  std::uint64_t triangles = 0;
  Eigen::AlignedBox3d bounds = {};  // of the mesh as it is
};

// The plants of an export.
struct ExportedPlants {
  const ModelFolder& folder;
  const farm::Farm& farm;
  const PlantSurfaces& surfaces;
  Collision collision;
};

// Writes one model a plant mesh, models/NAME: one plant, with the images of its materials.
std::vector<SinglePlant> write_single_plants(const ExportedPlants& plants);

// Writes the models: their meshes, one a material and link, and their descriptions.
EntityCounts write_merged_plants(const ExportedPlants& plants,
                                 const std::vector<MergedModel>& models,
                                 const ProgressReport& progress);

// The terrain: visual and collision with its mesh.
EntityCounts write_terrain_model(const ModelFolder& models, const farm::Farm& farm);

}  // namespace plotscan::gazebo
