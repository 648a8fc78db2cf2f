// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library.

#include <cstdint>
#include <string>
#include <vector>

#include "lidar/embree.h"
#include "lidar/optics.h"
#include "mesh/mesh.h"

namespace plotscan::lidar {

// Throws when the last calls of Embree on this thread failed.
void require_success(RTCDevice device, const std::string& what);

// A scene without geometries.
SceneHandle new_scene(RTCDevice device);

// Meshes ready for ray tracing (Embree), each stored once. Scenes may place them from several
// threads, and must not outlive them.
class MeshTrees {
 public:
  // Only the meshes that are to be instanced get a tree of their own.
  MeshTrees(const std::vector<mesh::Mesh>& meshes, const std::vector<bool>& instanced);
  MeshTrees(const MeshTrees&) = delete;
  MeshTrees& operator=(const MeshTrees&) = delete;

  RTCDevice device() const { return device_.get(); }
  RTCScene tree(std::uint32_t mesh) const { return trees_[mesh].get(); }
  const MeshOptics& optics(std::uint32_t mesh) const { return optics_[mesh]; }
  // The mesh's triangles, to be placed in a scene directly. The mesh is the one of that number.
  Geometry triangles(std::uint32_t number, const mesh::Mesh& mesh);

 private:
  Device device_;
  std::vector<MeshOptics> optics_;  // does not grow: geometries keep pointers to them
  std::vector<SceneHandle> trees_;  // null for a mesh that is not instanced
};

}  // namespace plotscan::lidar
