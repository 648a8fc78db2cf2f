// SPDX-License-Identifier: Apache-2.0
#include "lidar/internal/mesh_trees.h"

#include <algorithm>
#include <new>

#include "core/error.h"

namespace plotscan::lidar {
namespace {

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

}  // namespace

void require_success(RTCDevice device, const std::string& what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  check(error == RTC_ERROR_NONE, what + " fails in Embree with error " + std::to_string(error));
}

// Robust: a ray through the common edge of two triangles never slips between them. It costs about
// a tenth of the casting time.
SceneHandle new_scene(RTCDevice device) {
  SceneHandle scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  return scene;
}

MeshTrees::MeshTrees(const std::vector<mesh::Mesh>& meshes, const std::vector<bool>& instanced)
    : device_(rtcNewDevice(nullptr)), optics_(meshes.begin(), meshes.end()) {
  check(device_ != nullptr, "Embree has a device");
  trees_.resize(meshes.size());
  on_one_thread([&] {
    for (std::uint32_t i = 0; i < meshes.size(); ++i) {
      if (!instanced[i]) continue;
      trees_[i] = new_scene(device());
      rtcAttachGeometry(tree(i), triangles(i, meshes[i]).get());
      rtcCommitScene(tree(i));
    }
  });
}

Geometry MeshTrees::triangles(std::uint32_t number, const mesh::Mesh& mesh) {
  Geometry geometry(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertex = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), mesh.vertices.size()));
  auto* index = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  require_success(device(), "a mesh's memory");
  for (const Eigen::Vector3f& v : mesh.vertices) vertex = std::copy(v.begin(), v.end(), vertex);
  for (const auto& t : mesh.triangles) index = std::copy(t.begin(), t.end(), index);
  MeshOptics& optics = optics_[number];
  if (optics.has_masks()) {
    rtcSetGeometryUserData(geometry.get(), &optics);
    rtcSetGeometryIntersectFilterFunction(geometry.get(), pass_holes);
  }
  rtcCommitGeometry(geometry.get());
  return geometry;
}

}  // namespace plotscan::lidar
