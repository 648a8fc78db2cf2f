// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "estimate/estimate.h"

namespace plotscan::estimate {

// Plots that have the given boxes (world frame), in the frame of a map's origin, numbered from 1.
// `trials` are those of the boxes, or none.
std::vector<PlotEstimate> given_plots(const std::vector<PlotBox>& boxes,
                                      const Eigen::Vector3d& origin,
                                      const std::vector<int>& trials = {});

}  // namespace plotscan::estimate
