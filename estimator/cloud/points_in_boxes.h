// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::cloud {

// The points inside each of the boxes, in the points' order; a point may lie in several boxes.
std::vector<std::vector<Eigen::Vector3f>> points_in_boxes(std::span<const Eigen::Vector3f> points,
                                                          const std::vector<PlotBox>& boxes);

}  // namespace plotscan::cloud
