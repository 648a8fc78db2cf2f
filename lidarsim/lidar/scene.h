// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lidar/rays.h"
#include "lidar/scene_content.h"

namespace plotscan::lidar {

class MeshTrees;
class Sway;

// Where a ray first hits a surface.
struct Hit {
  float range_m = 0;          // infinite: the ray hits nothing
  float cos_incidence = 0;    // of the angle between the ray and the surface's normal, in [0, 1]
  float reflectance = 0;      // of the surface there at 903 nm, diffuse, in [0, 1]
  std::uint32_t surface = 0;  // index for Scene::surface
};

// Meshes ready for ray tracing (Embree). Each mesh is stored once and instanced where it is placed;
// a mesh without a transform (a terrain) is used directly. Rays pass through the holes of a
// material's mask.
class Scene {
 public:
  explicit Scene(const SceneContent& content) : Scene(content, nullptr) {}
  // A scene whose rooted meshes sway.
  Scene(const SceneContent& content, const Sway& sway) : Scene(content, &sway) {}
  // A scene of meshes that it shares with others, each of them instanced.
  Scene(const MeshTrees& meshes, std::span<const PlacedMesh> placed);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  // The nearest hit of each ray within max_range_m. May be called by several threads.
  void cast(std::span<const Ray> rays, float max_range_m, std::span<Hit> hits) const;
  // The same for rays in bundles: each run of `bundle` consecutive rays lies close together. Twice
  // as fast, except where plants sway. A ray within micrometres of an edge may give another hit.
  void cast_bundles(const RayArrays& rays, std::size_t bundle, float max_range_m,
                    std::span<Hit> hits) const;
  const Surface& surface(const Hit& hit) const { return surfaces_[hit.surface]; }

  // Bounds of z in the scene, world frame, metres.
  float top_m() const { return top_m_; }
  float bottom_m() const { return bottom_m_; }

  // For the speed benchmark: the Embree scene (RTCScene) itself.
  void* native() const;

 private:
  struct Trees;
  // Where a ray meets a triangle.
  struct Meeting {
    float range_m;
    Eigen::Vector3f normal;  // in the mesh's frame, of any length
    std::uint32_t surface;
    std::uint32_t triangle;
  };

  Scene(const SceneContent& content, const Sway* sway);
  // `geometry_of` makes the geometry of a placed mesh.
  template <class GeometryOf>
  void build_world(std::span<const PlacedMesh> all, const GeometryOf& geometry_of);
  bool goes_to_the_sky(const Ray& ray) const;
  Hit hit_of(const Eigen::Vector3f& direction, const Meeting& met) const;
  // Casts rays [begin, begin + count), which are at most kPacket.
  void cast_packet(const RayArrays& rays, std::size_t begin, std::size_t count, float max_range_m,
                   std::span<Hit> hits) const;

  std::unique_ptr<Trees> trees_;
  const MeshTrees* meshes_ = nullptr;
  std::vector<Surface> surfaces_;                  // in the order of the placed meshes
  std::vector<std::uint32_t> mesh_of_surface_;     // in MeshTrees
  std::vector<Eigen::Matrix3f> normal_from_mesh_;  // turns normals into the world
  float top_m_ = 0;
  float bottom_m_ = 0;
};

}  // namespace plotscan::lidar
