// SPDX-License-Identifier: Apache-2.0
#pragma once

// The one place that knows which Embree the system has.

#include <memory>
#include <type_traits>

#include <Eigen/Core>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace plotscan::lidar {

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

// The context of a cast. Embree passes it to the cast's callbacks as a QueryContext.
struct CastContext {
  QueryContext query;
  double time_s;  // of the ray, seconds from take-off

  explicit CastContext(double time) : time_s(time) {
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&query);
#else
    rtcInitIntersectContext(&query);
#endif
  }
};

// A ray to be cast, between two distances.
inline RTCRayHit query_of(const Eigen::Vector3f& origin_m, const Eigen::Vector3f& direction,
                          float near_m, float far_m) {
  RTCRayHit query;
  query.ray.org_x = origin_m.x();
  query.ray.org_y = origin_m.y();
  query.ray.org_z = origin_m.z();
  query.ray.tnear = near_m;
  query.ray.dir_x = direction.x();
  query.ray.dir_y = direction.y();
  query.ray.dir_z = direction.z();
  query.ray.time = 0;
  query.ray.tfar = far_m;
  query.ray.mask = ~0u;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

// Casts one ray for its nearest hit, at the given time, on which moving geometry depends.
inline void intersect(RTCScene scene, RTCRayHit& ray, double time_s = 0) {
  CastContext context(time_s);
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context.query;
  rtcIntersect1(scene, &ray, &arguments);
#else
  rtcIntersect1(scene, &context.query, &ray);
#endif
}

// The same for a packet of up to kPacket rays close together, all at one time. Only rays whose
// entry in `valid` is -1 are cast.
inline constexpr std::size_t kPacket = 8;
inline void intersect(RTCScene scene, const int* valid, RTCRayHit8& rays, double time_s) {
  CastContext context(time_s);
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context.query;
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &rays, &arguments);
#else
  context.query.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &context.query, &rays);
#endif
}

// The time that a callback's ray was cast for.
inline double time_of(const QueryContext* context) {
  return reinterpret_cast<const CastContext*>(context)->time_s;  // NOLINT(*-reinterpret-cast)
}

template <auto release>
struct Release {
  template <class Handle>
  void operator()(Handle* handle) const {
    release(handle);
  }
};

using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release<rtcReleaseDevice>>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release<rtcReleaseScene>>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Release<rtcReleaseGeometry>>;

}  // namespace plotscan::lidar
