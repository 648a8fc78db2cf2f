// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cloud/cloud_map.h"
#include <Eigen/Core>

#include "core/plot_box.h"
#include "estimate/estimate.h"

namespace plotscan::methods {

// Plots that have the given boxes (world frame), in the frame of a map's origin, numbered from 1.
std::vector<estimate::PlotEstimate> given_plots(const std::vector<PlotBox>& boxes,
                                                const Eigen::Vector3d& origin);

// The rectangle that holds the boxes when both ends of each are lengthened by extend_m.
cloud::Area surroundings(const std::vector<PlotBox>& boxes, double extend_m);

}  // namespace plotscan::methods
