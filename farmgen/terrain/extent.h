// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "terrain/terrain.h"

namespace plotscan::terrain {

// The box that holds the terrain's vertices, world frame, metres.
inline Eigen::AlignedBox3d extent_of(const Terrain& terrain) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : terrain.vertices()) box.extend(vertex);
  return box;
}

// The same as seen from above.
inline Eigen::AlignedBox2d outline_of(const Terrain& terrain) {
  const Eigen::AlignedBox3d box = extent_of(terrain);
  return {box.min().head<2>(), box.max().head<2>()};
}

}  // namespace plotscan::terrain
