// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace plotscan::methods::dhami2020 {

// The voxel filter of section IV-A: the centroid of the points in each cubic cell of edge voxel_m,
// cells bounded by multiples of voxel_m; in the order in which the cells first receive a point.
// PCL's VoxelGrid numbers its cells in 32 bits, which a field of 200 m overflows at 5 cm: it then
// returns the cloud unfiltered. Here an axis has 2^21 cells about the origin; what lies beyond is
// counted into the outermost.
std::vector<Eigen::Vector3f> voxel_filter(std::span<const Eigen::Vector3f> points, double voxel_m);

}  // namespace plotscan::methods::dhami2020
