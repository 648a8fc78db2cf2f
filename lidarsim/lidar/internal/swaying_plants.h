// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "lidar/embree.h"
#include "lidar/scene_content.h"
#include "lidar/sway.h"

namespace plotscan::lidar {

// Plants in the wind as Embree user geometries. Instead of bending the plant's mesh, each piece of
// a ray near it is transformed back to the plant at rest and tested against the mesh there. So bent
// plants need no triangles of their own, and have the bend of the ray's exact time.
class SwayingPlants {
 public:
  explicit SwayingPlants(const Sway& sway) : sway_(sway) {}

  // The mesh's scene (of one geometry) and this object must outlive the returned geometry. Hits
  // have the id of the returned geometry; their normals are those of a mesh that is transformed by
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
  std::deque<Plant> plants_;  // a deque, since Embree keeps pointers to the plants
};

}  // namespace plotscan::lidar
