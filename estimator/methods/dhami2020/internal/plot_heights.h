// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "estimate/estimate.h"
#include "methods/dhami2020/dhami2020.h"

namespace plotscan::methods::dhami2020 {

// Measures every plot (section IV-C): its `points`, its `ground` and its heights_m "voxel-max",
// "raw-max" and "raw-p99" over the ground plane of its box, lengthened by extend_m at both ends.
// The plane comes from the voxel-filtered points; heights are those of the points above it by more
// than the plane's tolerance: voxel-filtered ones, or raw ones and voxel-filtered ones together. A
// plot without a plane, or without a point above it, has no heights. Plots, raw and voxels share
// one frame.
void measure_heights(std::vector<estimate::PlotEstimate>& plots,
                     std::span<const Eigen::Vector3f> raw, std::span<const Eigen::Vector3f> voxels,
                     const Options& options);

}  // namespace plotscan::methods::dhami2020
