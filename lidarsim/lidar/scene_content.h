// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "farm/farm.h"
#include "gazebo/static_world.h"
#include "mesh/mesh.h"
#include "scan/point.h"

namespace plotscan::lidar {

// The properties of a surface that a hit lies on.
struct Surface {
  scan::PointClass label = scan::PointClass::unlabelled;
  std::uint32_t plot = 0;   // 0: none
  std::uint32_t plant = 0;  // Plant::id; 0: none
  // Diffuse, at 903 nm, in [0, 1]: for materials that state no reflectance and whose names tell
  // none.
  float reflectance = 0;
};

// A mesh somewhere in the world.
struct PlacedMesh {
  std::uint32_t mesh = 0;  // index into SceneContent::meshes
  Eigen::Affine3d world_from_mesh = Eigen::Affine3d::Identity();
  Surface surface;
  bool rooted = false;  // a plant whose foot is the mesh's origin: it may sway
};

// Everything that a laser can hit, from any source; world frame, metres, z up.
struct SceneContent {
  std::vector<mesh::Mesh> meshes;  // only triangles, reflectances and masks, not their looks
  std::vector<PlacedMesh> placed;
};

// The content of a farm: its plants in their order, then its terrain. Throws InputError when a
// plant names a missing model.
SceneContent scene_content(const farm::Farm& farm);
// The same in parts: the meshes of the models and of the terrain (throws likewise), a plant, and
// the terrain.
std::vector<mesh::Mesh> scene_meshes(const farm::Farm& farm);
PlacedMesh placed_plant(const farm::Plant& plant);
PlacedMesh placed_terrain(const farm::Farm& farm);
// The content of a world: its surfaces in their order.
SceneContent scene_content(const gazebo::StaticWorld& world);

}  // namespace plotscan::lidar
