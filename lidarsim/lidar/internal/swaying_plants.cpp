// SPDX-License-Identifier: Apache-2.0
#include "lidar/internal/swaying_plants.h"

#include <algorithm>
#include <cmath>

#include "lidar/internal/bent_stem.h"

namespace plotscan::lidar {
namespace {

// A ray relative to a plant's foot.
struct LocalRay {
  Eigen::Vector3f origin_m;
  Eigen::Vector3f direction;
};

// The part of a ray within a bent link, as ray parameters; slightly longer, so that nothing is lost
// between two links.
struct Span {
  float begin = 0;
  float end = 0;
};

Span span_of(const StemLink& link, const LocalRay& ray) {
  // A horizontal ray stays in one link: its parameters at the link's ends are huge.
  constexpr float kLevel = 1e-12f;
  constexpr float kOverlap = 2e-6f;
  const float rise =
      std::copysign(std::max(std::abs(ray.direction.z()), kLevel), ray.direction.z());
  const float first = (link.bottom_m - ray.origin_m.z()) / rise;
  const float second = (link.top_m - ray.origin_m.z()) / rise;
  const float more = kOverlap * (1 + std::abs(ray.origin_m.z())) / std::abs(rise);
  return {std::min(first, second) - more, std::max(first, second) + more};
}

LocalRay at_rest(const StemLink& link, const LocalRay& ray) {
  const auto vector_at_rest = [&](const Eigen::Vector2f& across, float up) {
    const float rest_up = up / link.upward;
    const Eigen::Vector2f rest_across = across - rest_up * link.sideways;
    return Eigen::Vector3f(rest_across.x(), rest_across.y(), rest_up);
  };
  // What is below the foot does not move; its link has no finite bottom.
  const float bottom_m = std::max(link.bottom_m, 0.0f);
  const float rest_bottom_m = std::max(link.rest_bottom_m, 0.0f);
  LocalRay rest{vector_at_rest(ray.origin_m.head<2>() - link.offset_m, ray.origin_m.z() - bottom_m),
                vector_at_rest(ray.direction.head<2>(), ray.direction.z())};
  rest.origin_m.z() += rest_bottom_m;
  return rest;
}

// The normal at rest, transformed with the link.
Eigen::Vector3f bent_normal(const StemLink& link, const Eigen::Vector3f& rest) {
  return {rest.x(), rest.y(), (rest.z() - link.sideways.dot(rest.head<2>())) / link.upward};
}

}  // namespace

Geometry SwayingPlants::add(RTCDevice device, RTCScene mesh_tree, const mesh::Mesh& mesh,
                            const PlacedMesh& placed) {
  const Eigen::Vector3d foot_m = placed.world_from_mesh.translation();
  const Eigen::Matrix3d turn = placed.world_from_mesh.linear();
  const Eigen::AlignedBox3f box = box_over_foot(mesh, placed);
  const float height_m = std::max(box.max().z(), 0.0f);
  const Sway::Motion motion =
      sway_.motion_of(placed.surface.plant, foot_m.head<2>(), static_cast<double>(height_m));
  const float reach_m = tip_reach_m(height_m, static_cast<float>(sway_.greatest_lean_rad(motion)));
  const Eigen::Vector3f foot = foot_m.cast<float>();
  const Eigen::Vector3f low = foot + box.min() - Eigen::Vector3f(reach_m, reach_m, 0);
  const Eigen::Vector3f high = foot + box.max() + Eigen::Vector3f(reach_m, reach_m, 0);
  plants_.push_back({.sway = &sway_,
                     .mesh_tree = mesh_tree,
                     .motion = motion,
                     .foot_m = foot,
                     .height_m = height_m,
                     .bottom_m = box.min().z(),
                     .mesh_from_world = turn.inverse().cast<float>(),
                     .world_from_mesh = turn.cast<float>(),
                     .bounds = {.lower_x = low.x(),
                                .lower_y = low.y(),
                                .lower_z = std::min(low.z(), foot.z()),
                                .align0 = 0,
                                .upper_x = high.x(),
                                .upper_y = high.y(),
                                .upper_z = high.z(),
                                .align1 = 0}});
  Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), 1);
  rtcSetGeometryUserData(geometry.get(), &plants_.back());
  rtcSetGeometryBoundsFunction(geometry.get(), bounds_of, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), intersect_plant);
  rtcCommitGeometry(geometry.get());
  return geometry;
}

void SwayingPlants::bounds_of(const RTCBoundsFunctionArguments* arguments) {
  *arguments->bounds_o = static_cast<const Plant*>(arguments->geometryUserPtr)->bounds;
}

void SwayingPlants::intersect_plant(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  // Rays are cast one by one, and a packet of one ray is that ray.
  auto& ray = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);  // NOLINT(*-reinterpret-cast)
  const auto& plant = *static_cast<const Plant*>(arguments->geometryUserPtr);
  if (!meets(plant, time_of(arguments->context), ray)) return;
  ray.hit.geomID = arguments->geomID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}

bool SwayingPlants::meets(const Plant& plant, double time_s, RTCRayHit& ray) {
  const LocalRay local{Eigen::Vector3f(ray.ray.org_x, ray.ray.org_y, ray.ray.org_z) - plant.foot_m,
                       {ray.ray.dir_x, ray.ray.dir_y, ray.ray.dir_z}};
  const BentStem stem(plant.height_m, plant.sway->lean_rad(plant.motion, time_s).cast<float>());
  const auto& links = stem.links();
  const bool falls = local.direction.z() < 0;
  // The first link is only needed if the plant has parts below its foot.
  const std::size_t lowest = plant.bottom_m < 0 ? 0 : 1;
  for (std::size_t i = lowest; i < links.size(); ++i) {
    const StemLink& link = links[falls ? links.size() - 1 - i + lowest : i];
    const Span span = span_of(link, local);
    const float begin = std::max(span.begin, ray.ray.tnear);
    const float end = std::min(span.end, ray.ray.tfar);
    if (begin > end) continue;
    const LocalRay rest = at_rest(link, local);
    RTCRayHit query = query_of(plant.mesh_from_world * rest.origin_m,
                               plant.mesh_from_world * rest.direction, begin, end);
    intersect(plant.mesh_tree, query, time_s);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    ray.ray.tfar = query.ray.tfar;
    ray.hit = query.hit;
    const Eigen::Vector3f in_mesh(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    const Eigen::Vector3f normal = plant.world_from_mesh.transpose() *
                                   bent_normal(link, plant.mesh_from_world.transpose() * in_mesh);
    ray.hit.Ng_x = normal.x();
    ray.hit.Ng_y = normal.y();
    ray.hit.Ng_z = normal.z();
    return true;
  }
  return false;
}

}  // namespace plotscan::lidar
