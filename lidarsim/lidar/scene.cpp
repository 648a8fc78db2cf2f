// SPDX-License-Identifier: Apache-2.0
#include "lidar/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <tbb/task_arena.h>

#include "core/error.h"
#include "lidar/embree.h"
#include "lidar/internal/swaying_plants.h"

namespace plotscan::lidar {

struct Scene::Trees {
  Device device;
  std::optional<SwayingPlants> swaying;
  std::vector<SceneHandle> meshes;  // null if no instance needs it
  SceneHandle world;
};

namespace {

void require_success(RTCDevice device, const std::string& what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  check(error == RTC_ERROR_NONE, what + " fails in Embree with error " + std::to_string(error));
}

// Rejects hits where the material's mask has a hole (an Embree filter function).
void pass_holes(const RTCFilterFunctionNArguments* hits) {
  const auto& optics = *static_cast<const MeshOptics*>(hits->geometryUserPtr);
  for (unsigned i = 0; i < hits->N; ++i) {
    if (hits->valid[i] == 0) continue;
    const bool opaque =
        optics.is_opaque(RTCHitN_primID(hits->hit, hits->N, i), RTCHitN_u(hits->hit, hits->N, i),
                         RTCHitN_v(hits->hit, hits->N, i));
    if (!opaque) hits->valid[i] = 0;
  }
}

// Keeps a pointer to `optics`, which must not move.
Geometry triangle_geometry(RTCDevice device, const mesh::Mesh& mesh, MeshOptics& optics) {
  Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertex = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), mesh.vertices.size()));
  auto* index = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  require_success(device, "a mesh's memory");
  for (const Eigen::Vector3f& v : mesh.vertices) vertex = std::copy(v.begin(), v.end(), vertex);
  for (const auto& t : mesh.triangles) index = std::copy(t.begin(), t.end(), index);
  if (optics.has_masks()) {
    rtcSetGeometryUserData(geometry.get(), &optics);
    rtcSetGeometryIntersectFilterFunction(geometry.get(), pass_holes);
  }
  rtcCommitGeometry(geometry.get());
  return geometry;
}

// Robust: a ray through the common edge of two triangles never slips between them. It costs about
// a tenth of the casting time.
SceneHandle new_scene(RTCDevice device) {
  SceneHandle scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  return scene;
}

bool is_instance(const PlacedMesh& placed) {
  return placed.world_from_mesh.matrix() != Eigen::Matrix4d::Identity();
}

Geometry instance_of(RTCDevice device, RTCScene mesh, const Eigen::Affine3d& world_from_mesh) {
  Geometry instance(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(instance.get(), mesh);
  const Eigen::Affine3f pose = world_from_mesh.cast<float>();
  rtcSetGeometryTransform(instance.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, pose.data());
  rtcCommitGeometry(instance.get());
  return instance;
}

}  // namespace

Scene::Scene(const SceneContent& content, const Sway* sway) : trees_(std::make_unique<Trees>()) {
  if (sway != nullptr) trees_->swaying.emplace(*sway);
  for (const PlacedMesh& placed : content.placed) {
    check(placed.mesh < content.meshes.size(), "every placed mesh is there");
    surfaces_.push_back(placed.surface);
    mesh_of_surface_.push_back(placed.mesh);
    normal_from_mesh_.emplace_back(
        placed.world_from_mesh.linear().inverse().transpose().cast<float>());
  }
  optics_.reserve(content.meshes.size());  // no reallocation: the trees keep pointers to them
  for (const mesh::Mesh& mesh : content.meshes) optics_.emplace_back(mesh);
  // One thread builds the trees: where two triangles are hit at the same distance the answer
  // depends on the tree, and the tree must not depend on the number of threads.
  tbb::task_arena one_thread(1);
  one_thread.execute([&] { build_trees(content); });
  RTCBounds bounds;
  rtcGetSceneBounds(trees_->world.get(), &bounds);
  top_m_ = bounds.upper_z;
  bottom_m_ = bounds.lower_z;
}

void Scene::build_trees(const SceneContent& content) {
  trees_->device.reset(rtcNewDevice(nullptr));
  RTCDevice device = trees_->device.get();
  check(device != nullptr, "Embree has a device");
  trees_->meshes.resize(content.meshes.size());
  trees_->world = new_scene(device);
  RTCScene world = trees_->world.get();
  for (unsigned id = 0; id < content.placed.size(); ++id) {
    const PlacedMesh& placed = content.placed[id];
    const mesh::Mesh& mesh = content.meshes[placed.mesh];
    SceneHandle& tree = trees_->meshes[placed.mesh];
    const bool sways = trees_->swaying && placed.rooted;
    if (!sways && !is_instance(placed)) {
      rtcAttachGeometryByID(world, triangle_geometry(device, mesh, optics_[placed.mesh]).get(), id);
      continue;
    }
    if (tree == nullptr) {
      tree = new_scene(device);
      rtcAttachGeometry(tree.get(), triangle_geometry(device, mesh, optics_[placed.mesh]).get());
      rtcCommitScene(tree.get());
    }
    const Geometry geometry = sways ? trees_->swaying->add(device, tree.get(), mesh, placed)
                                    : instance_of(device, tree.get(), placed.world_from_mesh);
    rtcAttachGeometryByID(world, geometry.get(), id);
  }
  rtcCommitScene(world);
  require_success(device, "the scene");
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
          .reflectance = optics_[mesh_of_surface_[met.surface]].reflectance(
              met.triangle, surfaces_[met.surface].reflectance),
          .surface = met.surface};
}

void Scene::cast(std::span<const Ray> rays, float max_range_m, std::span<Hit> hits) const {
  check(hits.size() >= rays.size(), "every ray has room for its hit");
  RTCScene world = trees_->world.get();
  RTCRayHit query;
  query.ray.time = 0;
  query.ray.mask = ~0u;
  query.ray.flags = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    hits[i].range_m = std::numeric_limits<float>::infinity();
    if (goes_to_the_sky(ray)) continue;
    query.ray.org_x = ray.origin_m.x();
    query.ray.org_y = ray.origin_m.y();
    query.ray.org_z = ray.origin_m.z();
    query.ray.tnear = 0;
    query.ray.dir_x = ray.direction.x();
    query.ray.dir_y = ray.direction.y();
    query.ray.dir_z = ray.direction.z();
    query.ray.tfar = max_range_m;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
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
