// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

namespace plotscan::methods::dhami2020 {

// A plane through `centroid`, its unit `normal` pointing up.
struct GroundPlane {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  std::size_t inliers = 0;  // points that RANSAC took for ground

  // Signed distance, metres, positive above.
  double height_of(const Eigen::Vector3d& point) const { return normal.dot(point - centroid); }
};

// The least-squares plane (section IV-C2): centroid, and the direction of least variance. At least
// three points.
GroundPlane least_squares_plane(std::span<const Eigen::Vector3d> points);

// The ground under a plot (section IV-C1, IV-C2): PCL's RANSAC for a plane with optimised
// coefficients, then least squares through its inliers, the points within tolerance_m. PCL draws
// its samples from a generator of its own with a fixed seed. Empty when there is no plane: fewer
// than three points, or all on a line.
std::optional<GroundPlane> find_ground_plane(std::span<const Eigen::Vector3d> points,
                                             double tolerance_m);

}  // namespace plotscan::methods::dhami2020
