// SPDX-License-Identifier: Apache-2.0
#include "lidar/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/task_arena.h>

#include "core/error.h"
#include "lidar/embree.h"

namespace plotscan::lidar {

struct Scene::Trees {
  Device device;
  std::vector<SceneHandle> models;
  SceneHandle world;
};

namespace {

using Triangle = std::array<std::uint32_t, 3>;

void require_success(RTCDevice device, const std::string& what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  check(error == RTC_ERROR_NONE, what + " fails in Embree with error " + std::to_string(error));
}

template <class Vertex>
Geometry triangle_geometry(RTCDevice device, const std::vector<Vertex>& vertices,
                           const std::vector<Triangle>& triangles) {
  Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX,
                                                             0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), vertices.size()));
  auto* index = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              sizeof(Triangle), triangles.size()));
  require_success(device, "a mesh's memory");
  for (const Vertex& v : vertices)
    for (int axis = 0; axis < 3; ++axis) *vertex++ = static_cast<float>(v[axis]);
  for (const Triangle& t : triangles) index = std::copy(t.begin(), t.end(), index);
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

Eigen::Affine3d world_from_model(const farm::Plant& plant) {
  return Eigen::Translation3d(plant.position) * plant.rotation * Eigen::Scaling(plant.scale);
}

Geometry plant_instance(RTCDevice device, RTCScene model, const farm::Plant& plant) {
  Geometry instance(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(instance.get(), model);
  const Eigen::Affine3f pose = world_from_model(plant).cast<float>();
  rtcSetGeometryTransform(instance.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, pose.data());
  rtcCommitGeometry(instance.get());
  return instance;
}

// The world scene: plants by their index, then the terrain.
SceneHandle world_scene(RTCDevice device, const farm::Farm& farm,
                        const std::vector<SceneHandle>& models) {
  SceneHandle world = new_scene(device);
  unsigned id = 0;
  for (const farm::Plant& plant : farm.plants) {
    if (plant.model >= models.size()) {
      throw InputError("plant " + std::to_string(plant.id) + " names model " +
                       std::to_string(plant.model) + "; the farm has " +
                       std::to_string(models.size()));
    }
    const Geometry instance = plant_instance(device, models[plant.model].get(), plant);
    rtcAttachGeometryByID(world.get(), instance.get(), id++);
  }
  const Geometry terrain =
      triangle_geometry(device, farm.terrain.vertices(), farm.terrain.triangles());
  rtcAttachGeometryByID(world.get(), terrain.get(), id);
  rtcCommitScene(world.get());
  require_success(device, "the scene");
  return world;
}

}  // namespace

Scene::Scene(const farm::Farm& farm) : trees_(std::make_unique<Trees>()) {
  // One thread builds the trees: where two triangles are hit at the same distance the answer
  // depends on the tree, and the tree must not depend on the number of threads.
  tbb::task_arena one_thread(1);
  one_thread.execute([&] { build_trees(farm); });
  for (const farm::Plant& plant : farm.plants) {
    const bool weed = plant.kind == farm::PlantKind::weed;
    surfaces_.push_back({.label = weed ? scan::PointClass::weed : scan::PointClass::crop,
                         .plot = plant.plot,
                         .plant = plant.id});
    const Eigen::Matrix3d linear = world_from_model(plant).linear();
    normal_from_model_.emplace_back(linear.inverse().transpose().cast<float>());
  }
  surfaces_.push_back({.label = scan::PointClass::ground});
  normal_from_model_.emplace_back(Eigen::Matrix3f::Identity());
  RTCBounds bounds;
  rtcGetSceneBounds(trees_->world.get(), &bounds);
  top_m_ = bounds.upper_z;
}

void Scene::build_trees(const farm::Farm& farm) {
  trees_->device.reset(rtcNewDevice(nullptr));
  RTCDevice device = trees_->device.get();
  check(device != nullptr, "Embree has a device");
  for (const farm::PlantModel& model : farm.models) {
    SceneHandle scene = new_scene(device);
    const Geometry mesh = triangle_geometry(device, model.mesh.vertices, model.mesh.triangles);
    rtcAttachGeometry(scene.get(), mesh.get());
    rtcCommitScene(scene.get());
    trees_->models.push_back(std::move(scene));
  }
  trees_->world = world_scene(device, farm, trees_->models);
}

Scene::~Scene() = default;

void* Scene::native() const { return trees_->world.get(); }

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
    if (ray.origin_m.z() > top_m_ && ray.direction.z() >= 0) continue;  // to the sky
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
    intersect(world, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    const bool is_plant = query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    const std::uint32_t surface = is_plant ? query.hit.instID[0] : query.hit.geomID;
    const Eigen::Vector3f normal = normal_from_model_[surface] *
                                   Eigen::Vector3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    hits[i] = {.range_m = query.ray.tfar,
               .cos_incidence = std::min(1.0f, std::abs(normal.dot(ray.direction)) / normal.norm()),
               .surface = surface};
  }
}

}  // namespace plotscan::lidar
