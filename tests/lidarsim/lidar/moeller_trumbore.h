// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include <Eigen/Geometry>

namespace plotscan::testing {

// The distance along the ray to the triangle (Moeller and Trumbore, JGT 1997); infinite: none.
inline double moeller_trumbore(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                               const std::array<Eigen::Vector3d, 3>& corners) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d edge1 = corners[1] - corners[0];
  const Eigen::Vector3d edge2 = corners[2] - corners[0];
  const Eigen::Vector3d p = direction.cross(edge2);
  const double determinant = edge1.dot(p);
  if (determinant == 0) return kNone;
  const Eigen::Vector3d to_origin = origin - corners[0];
  const double u = to_origin.dot(p) / determinant;
  const Eigen::Vector3d q = to_origin.cross(edge1);
  const double v = direction.dot(q) / determinant;
  const double t = edge2.dot(q) / determinant;
  return u < 0 || v < 0 || u + v > 1 || t < 0 ? kNone : t;
}

}  // namespace plotscan::testing
