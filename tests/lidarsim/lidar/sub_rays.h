// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lidar/internal/beam.h"

namespace plotscan::testing {

// The sub-rays of a shot, one by one.
inline std::vector<lidar::Ray> sub_rays_of(const lidar::SubRays& beam, const lidar::Ray& axis,
                                           const Eigen::Vector3f& spin_axis, std::uint64_t shot) {
  lidar::RayArrays arrays(beam.count());
  beam.spread(axis, spin_axis, shot, arrays, 0);
  std::vector<lidar::Ray> rays;
  for (std::size_t i = 0; i < arrays.size(); ++i) rays.push_back(arrays.at(i));
  return rays;
}

}  // namespace plotscan::testing
