// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::methods::lattice {

// Boxes that canopy would fill better somewhere near.
struct ShiftedBoxes {
  Eigen::Vector2d by_m = Eigen::Vector2d::Zero();  // from where they are to there, world frame
  double covered = 0;                              // share of their area under canopy, here
  double covered_there = 0;
};

// Looks up to 1.5 m around the boxes, all moved together, at the heights of returns above the
// ground. Nothing where no place is much better, or where the boxes do not lie about parallel.
std::optional<ShiftedBoxes> shifted_boxes(std::span<const Eigen::Vector3f> heights,
                                          const std::vector<PlotBox>& boxes, double noise_m);

}  // namespace plotscan::methods::lattice
