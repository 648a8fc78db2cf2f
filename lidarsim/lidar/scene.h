// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "farm/farm.h"
#include "scan/point.h"

namespace plotscan::lidar {

struct Ray {
  Eigen::Vector3f origin_m;   // world frame
  Eigen::Vector3f direction;  // unit vector
};

// Where a ray first meets the farm.
struct Hit {
  float range_m = 0;          // infinite: nowhere
  float cos_incidence = 0;    // of the angle between the ray and the surface's normal, in [0, 1]
  std::uint32_t surface = 0;  // index for Scene::surface
};

// What a hit lies on.
struct Surface {
  scan::PointClass label = scan::PointClass::unlabelled;
  std::uint32_t plot = 0;
  std::uint32_t plant = 0;  // Plant::id
};

// A farm ready for ray tracing: each plant mesh once, plants as instances of them, the terrain.
class Scene {
 public:
  // Throws InputError when a plant names a missing model.
  explicit Scene(const farm::Farm& farm);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  // The nearest hit of each ray within max_range_m. May be called by several threads.
  void cast(std::span<const Ray> rays, float max_range_m, std::span<Hit> hits) const;
  const Surface& surface(const Hit& hit) const { return surfaces_[hit.surface]; }

  // For the speed benchmark: the Embree scene (RTCScene) itself.
  void* native() const;

 private:
  struct Trees;

  void build_trees(const farm::Farm& farm);

  std::unique_ptr<Trees> trees_;
  std::vector<Surface> surfaces_;                   // of the plants, then of the terrain
  std::vector<Eigen::Matrix3f> normal_from_model_;  // of the plants: turns normals into the world
  float top_m_ = 0;                                 // nothing lies higher
};

}  // namespace plotscan::lidar
