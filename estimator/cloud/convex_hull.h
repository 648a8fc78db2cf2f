// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace plotscan::cloud {

// Counter-clockwise corners of the convex hull, from the westernmost, without points on its edges;
// the points themselves when there are fewer than three different ones (Andrew, "Another efficient
// algorithm for convex hulls in two dimensions", Information Processing Letters 9(5), 1979,
// 216-219).
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);

// Twice the area of the triangle a, b, c: positive when they turn left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace plotscan::cloud
