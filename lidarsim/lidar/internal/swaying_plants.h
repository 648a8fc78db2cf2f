// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library.

#include <deque>

#include <Eigen/Geometry>

#include "lidar/embree.h"
#include "lidar/scene_content.h"
#include "lidar/sway.h"

namespace plotscan::lidar {

// Plants in the wind as geometries of Embree's. A ray that comes near one is bent back, piece by
// piece, to how it runs past the plant at rest, and meets the plant's mesh there: a bent plant
// needs no triangles of its own, and is where it is at the very time of the ray.
class SwayingPlants {
 public:
  explicit SwayingPlants(const Sway& sway) : sway_(sway) {}

  // The mesh's scene, of one geometry, has to outlive the geometry, as these plants have to. Hits
  // have the geometry's own id, their normal is as if the mesh were turned by
  // placed.world_from_mesh alone.
  Geometry add(RTCDevice device, RTCScene mesh_tree, const mesh::Mesh& mesh,
               const PlacedMesh& placed);

 private:
  struct Plant {
    const Sway* sway;
    RTCScene mesh_tree;
    Sway::Motion motion;
    Eigen::Vector3f foot_m;  // world frame
    float height_m;
    float bottom_m;  // of the mesh, over the foot
    Eigen::Matrix3f mesh_from_world;
    Eigen::Matrix3f world_from_mesh;
    RTCBounds bounds;
  };

  static void bounds_of(const RTCBoundsFunctionArguments* arguments);
  static void intersect_plant(const RTCIntersectFunctionNArguments* arguments);
  static bool meets(const Plant& plant, double time_s, RTCRayHit& ray);

  Sway sway_;
  std::deque<Plant> plants_;  // which stay where they are
};

}  // namespace plotscan::lidar
