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

// What a hit lies on.
struct Surface {
  scan::PointClass label = scan::PointClass::unlabelled;
  std::uint32_t plot = 0;   // 0: none
  std::uint32_t plant = 0;  // Plant::id; 0: none
  // At 903 nm, diffuse, in [0, 1], of materials that state none and whose names say nothing.
  float reflectance = 0;
};

// A mesh somewhere in the world.
struct PlacedMesh {
  std::uint32_t mesh = 0;  // index into SceneContent::meshes
  Eigen::Affine3d world_from_mesh = Eigen::Affine3d::Identity();
  Surface surface;
  bool rooted = false;  // a plant whose foot is the mesh's origin: it may sway
};

// All that a laser can meet, wherever it comes from; metres, z up.
struct SceneContent {
  std::vector<mesh::Mesh> meshes;  // not their looks: triangles, reflectances, masks
  std::vector<PlacedMesh> placed;
};

// A farm's plants in their order, then its terrain. Throws InputError when a plant names a missing
// model.
SceneContent scene_content(const farm::Farm& farm);
// A world's surfaces in their order.
SceneContent scene_content(const gazebo::StaticWorld& world);

}  // namespace plotscan::lidar
