// SPDX-License-Identifier: Apache-2.0
#include "lidar/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "lidar/embree.h"
#include "lidar/internal/mesh_trees.h"
#include "lidar/internal/swaying_plants.h"

namespace plotscan::lidar {

struct Scene::Trees {
  std::optional<MeshTrees> own;  // of a scene that shares none
  std::optional<SwayingPlants> swaying;
  SceneHandle world;
};

namespace {

bool is_instance(const PlacedMesh& placed) {
  return placed.world_from_mesh.matrix() != Eigen::Matrix4d::Identity();
}

std::vector<bool> instanced_meshes(const SceneContent& content, bool sway) {
  std::vector<bool> instanced(content.meshes.size(), false);
  for (const PlacedMesh& placed : content.placed) {
    check(placed.mesh < content.meshes.size(), "every placed mesh is there");
    if (is_instance(placed) || (sway && placed.rooted)) instanced[placed.mesh] = true;
  }
  return instanced;
}

Geometry instance_of(const MeshTrees& meshes, const PlacedMesh& placed) {
  Geometry instance(rtcNewGeometry(meshes.device(), RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(instance.get(), meshes.tree(placed.mesh));
  const Eigen::Affine3f pose = placed.world_from_mesh.cast<float>();
  rtcSetGeometryTransform(instance.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, pose.data());
  rtcCommitGeometry(instance.get());
  return instance;
}

}  // namespace

Scene::Scene(const SceneContent& content, const Sway* sway) : trees_(std::make_unique<Trees>()) {
  if (sway != nullptr) trees_->swaying.emplace(*sway);
  trees_->own.emplace(content.meshes, instanced_meshes(content, sway != nullptr));
  meshes_ = &*trees_->own;
  build_world(content.placed, [&](const PlacedMesh& placed) {
    const mesh::Mesh& mesh = content.meshes[placed.mesh];
    if (sway != nullptr && placed.rooted)
      return trees_->swaying->add(meshes_->device(), meshes_->tree(placed.mesh), mesh, placed);
    return is_instance(placed) ? instance_of(*meshes_, placed)
                               : trees_->own->triangles(placed.mesh, mesh);
  });
}

Scene::Scene(const MeshTrees& meshes, std::span<const PlacedMesh> placed)
    : trees_(std::make_unique<Trees>()), meshes_(&meshes) {
  build_world(placed, [&](const PlacedMesh& each) { return instance_of(meshes, each); });
}

template <class GeometryOf>
void Scene::build_world(std::span<const PlacedMesh> all, const GeometryOf& geometry_of) {
  surfaces_.reserve(all.size());
  mesh_of_surface_.reserve(all.size());
  normal_from_mesh_.reserve(all.size());
  for (const PlacedMesh& placed : all) {
    surfaces_.push_back(placed.surface);
    mesh_of_surface_.push_back(placed.mesh);
    normal_from_mesh_.emplace_back(
        placed.world_from_mesh.linear().inverse().transpose().cast<float>());
  }
  trees_->world = new_scene(meshes_->device());
  RTCScene world = trees_->world.get();
  on_one_thread([&] {
    for (unsigned id = 0; id < all.size(); ++id)
      rtcAttachGeometryByID(world, geometry_of(all[id]).get(), id);
    rtcCommitScene(world);
    require_success(meshes_->device(), "the scene");
  });
  RTCBounds bounds;
  rtcGetSceneBounds(world, &bounds);
  top_m_ = bounds.upper_z;
  bottom_m_ = bounds.lower_z;
}

Scene::~Scene() = default;

void* Scene::native() const { return trees_->world.get(); }

bool Scene::goes_to_the_sky(const Ray& ray) const {
  return ray.origin_m.z() > top_m_ && ray.direction.z() >= 0;
}

Hit Scene::hit_of(const Eigen::Vector3f& direction, const Meeting& met) const {
  const Eigen::Vector3f normal = normal_from_mesh_[met.surface] * met.normal;
  return {.range_m = met.range_m,
          .cos_incidence = std::min(1.0f, std::abs(normal.dot(direction)) / normal.norm()),
          .reflectance = meshes_->optics(mesh_of_surface_[met.surface])
                             .reflectance(met.triangle, surfaces_[met.surface].reflectance),
          .surface = met.surface};
}

void Scene::cast(std::span<const Ray> rays, float max_range_m, std::span<Hit> hits) const {
  check(hits.size() >= rays.size(), "every ray has room for its hit");
  RTCScene world = trees_->world.get();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    hits[i].range_m = std::numeric_limits<float>::infinity();
    if (goes_to_the_sky(ray)) continue;
    RTCRayHit query = query_of(ray.origin_m, ray.direction, 0, max_range_m);
    intersect(world, query, ray.time_s);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    const bool in_instance = query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    hits[i] =
        hit_of(ray.direction, {.range_m = query.ray.tfar,
                               .normal = {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z},
                               .surface = in_instance ? query.hit.instID[0] : query.hit.geomID,
                               .triangle = query.hit.primID});
  }
}

void Scene::cast_packet(const RayArrays& rays, std::size_t begin, std::size_t count,
                        float max_range_m, std::span<Hit> hits) const {
  // Unused lanes repeat the last ray.
  const auto take = [&](const std::vector<float>& of_rays, float* lanes) {
    for (std::size_t i = 0; i < kPacket; ++i) lanes[i] = of_rays[begin + std::min(i, count - 1)];
  };
  RTCRayHit8 query;
  RTCRay8& ray = query.ray;
  RTCHit8& hit = query.hit;
  take(rays.origin_m[0], ray.org_x);
  take(rays.origin_m[1], ray.org_y);
  take(rays.origin_m[2], ray.org_z);
  take(rays.direction[0], ray.dir_x);
  take(rays.direction[1], ray.dir_y);
  take(rays.direction[2], ray.dir_z);
  alignas(32) std::array<int, kPacket> valid;
  for (std::size_t i = 0; i < kPacket; ++i) {
    valid[i] = i < count && !(ray.org_z[i] > top_m_ && ray.dir_z[i] >= 0) ? -1 : 0;
    ray.tnear[i] = 0;
    ray.time[i] = 0;
    ray.tfar[i] = max_range_m;
    ray.mask[i] = ~0u;
    ray.flags[i] = 0;
    hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  intersect(trees_->world.get(), valid.data(), query, rays.time_s[begin]);
  for (std::size_t i = 0; i < count; ++i) {
    Hit& met = hits[begin + i];
    met.range_m = std::numeric_limits<float>::infinity();
    if (hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const bool in_instance = hit.instID[0][i] != RTC_INVALID_GEOMETRY_ID;
    met = hit_of({ray.dir_x[i], ray.dir_y[i], ray.dir_z[i]},
                 {.range_m = ray.tfar[i],
                  .normal = {hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]},
                  .surface = in_instance ? hit.instID[0][i] : hit.geomID[i],
                  .triangle = hit.primID[i]});
  }
}

void Scene::cast_bundles(const RayArrays& rays, std::size_t bundle, float max_range_m,
                         std::span<Hit> hits) const {
  check(hits.size() >= rays.size(), "every ray has room for its hit");
  if (trees_->swaying) {
    std::vector<Ray> one_by_one;
    one_by_one.reserve(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) one_by_one.push_back(rays.at(i));
    return cast(one_by_one, max_range_m, hits);
  }
  for (std::size_t begin = 0; begin < rays.size(); begin += bundle) {
    for (std::size_t i = 0; i < bundle; i += kPacket)
      cast_packet(rays, begin + i, std::min(kPacket, bundle - i), max_range_m, hits);
  }
}

}  // namespace plotscan::lidar
