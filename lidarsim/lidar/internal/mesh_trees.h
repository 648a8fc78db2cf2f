// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tbb/task_arena.h>

#include "lidar/embree.h"
#include "lidar/internal/optics.h"
#include "mesh/mesh.h"

namespace plotscan::lidar {

// One thread builds trees: where two triangles are hit at the same distance the answer depends on
// the tree, and the tree must not depend on the number of threads.
template <class Build>
void on_one_thread(const Build& build) {
  tbb::task_arena one_thread(1);
  one_thread.execute(build);
}

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
  // The triangles of the mesh of that number, to be placed in a scene directly.
  Geometry triangles(std::uint32_t number, const mesh::Mesh& mesh);

 private:
  Device device_;
  std::vector<MeshOptics> optics_;  // does not grow: geometries keep pointers to them
  std::vector<SceneHandle> trees_;  // null for a mesh that is not instanced
};

}  // namespace plotscan::lidar
