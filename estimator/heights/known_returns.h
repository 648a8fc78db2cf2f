// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "ground/surface.h"
#include "heights/plot_ground.h"

namespace plotscan::heights {

// The returns (x, y, height above the ground) that a plot's heights are measured from, and the
// ground under them.
struct KnownReturns {
  std::vector<Eigen::Vector3f> points = {};
  PlotGround ground = {};
};

// The plot's returns over known ground. Left out are returns over ground whose standard error is
// above 5 cm, or above 1.5 times the plot's median where that is more, and returns on a ridge that
// the ground's model cut off: places of which both the lowest and the highest returns stand out
// from the plot's other places (no plant does so), and places beside these of which the highest
// returns stand out. If they are more than a quarter of the plot, they are no ridge and stay. Own
// choice, docs/plot-heights.md.
KnownReturns known_returns(const PlotBox& box, std::span<const Eigen::Vector3f> points,
                           const ground::Surface& surface);

}  // namespace plotscan::heights
