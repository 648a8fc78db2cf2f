// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Core>

namespace plotscan::methods::dhami2020 {

// The whole field's ground as z = offset_m + slope . (x, y); a levelled map has it subtracted.
struct GroundLevel {
  double offset_m = 0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();

  double height_of(const Eigen::Vector3f& point) const {
    return point.z() - offset_m - slope.dot(point.head<2>().cast<double>());
  }
};

// Levels the map, so that its ground is near z = 0 as section IV-B assumes of its own: the plane of
// least absolute deviations through the lowest point of each cell of 1 m, then raised from under
// the range noise to the mean of the points about it. As long as fewer than half of the cells are
// closed by canopy, it lies on the ground of a flat field; on rolling ground half of the cells'
// lowest points lie below it. `points` are voxel-filtered and not empty.
GroundLevel fit_ground_level(std::span<const Eigen::Vector3f> points);

}  // namespace plotscan::methods::dhami2020
