// SPDX-License-Identifier: Apache-2.0
#include "lidar/scene_content.h"

#include <string>

#include "core/error.h"
#include "mesh/reflectance.h"

namespace plotscan::lidar {
namespace {

void require_model(const farm::Farm& farm, const farm::Plant& plant) {
  if (plant.model < farm.models.size()) return;
  throw InputError("plant " + std::to_string(plant.id) + " names model " +
                   std::to_string(plant.model) + "; the farm has " +
                   std::to_string(farm.models.size()));
}

float reflectance_of(scan::PointClass label) {
  return label == scan::PointClass::ground ? mesh::kSoilReflectance : mesh::kLeafReflectance;
}

// A copy of the mesh without what a laser does not see.
mesh::Mesh unseen_left_out(const mesh::Mesh& mesh) {
  mesh::Mesh kept{.vertices = mesh.vertices,
                  .triangles = mesh.triangles,
                  .materials = mesh.materials,
                  .triangle_material = mesh.triangle_material};
  bool masked = false;
  for (mesh::Material& material : kept.materials) {
    material.texture.reset();
    masked = masked || material.mask != nullptr;
  }
  if (masked) kept.texture_coordinates = mesh.texture_coordinates;
  return kept;
}

Surface surface_of(const farm::Plant& plant) {
  const bool weed = plant.kind == farm::PlantKind::weed;
  return {.label = weed ? scan::PointClass::weed : scan::PointClass::crop,
          .plot = plant.plot,
          .plant = plant.id,
          .reflectance = mesh::kLeafReflectance};
}

}  // namespace

std::vector<mesh::Mesh> scene_meshes(const farm::Farm& farm) {
  for (const farm::Plant& plant : farm.plants) require_model(farm, plant);
  std::vector<mesh::Mesh> meshes;
  for (const farm::PlantModel& model : farm.models) meshes.push_back(unseen_left_out(model.mesh));
  meshes.push_back(terrain::mesh_of(farm.terrain));
  return meshes;
}

PlacedMesh placed_plant(const farm::Plant& plant) {
  return {.mesh = plant.model,
          .world_from_mesh = farm::world_from_plant(plant),
          .surface = surface_of(plant),
          .rooted = true};
}

PlacedMesh placed_terrain(const farm::Farm& farm) {
  return {.mesh = static_cast<std::uint32_t>(farm.models.size()),
          .surface = {.label = scan::PointClass::ground,
                      .reflectance = static_cast<float>(
                          farm.soil_reflectance.value_or(mesh::kSoilReflectance))}};
}

SceneContent scene_content(const farm::Farm& farm) {
  SceneContent content{.meshes = scene_meshes(farm), .placed = {}};
  content.placed.reserve(farm.plants.size() + 1);
  for (const farm::Plant& plant : farm.plants) content.placed.push_back(placed_plant(plant));
  content.placed.push_back(placed_terrain(farm));
  return content;
}

SceneContent scene_content(const gazebo::StaticWorld& world) {
  SceneContent content;
  for (const mesh::Mesh& mesh : world.meshes) content.meshes.push_back(unseen_left_out(mesh));
  content.placed.reserve(world.surfaces.size());
  for (const gazebo::PlacedSurface& surface : world.surfaces) {
    // The numbers of both classes are the same (farm/surface_class.h).
    const auto label = static_cast<scan::PointClass>(surface.kind);
    content.placed.push_back({.mesh = surface.mesh,
                              .world_from_mesh = surface.world_from_mesh,
                              .surface = {.label = label,
                                          .plot = surface.plot,
                                          .plant = surface.plant,
                                          .reflectance = reflectance_of(label)}});
  }
  return content;
}

}  // namespace plotscan::lidar
