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

// Those of the plot's returns whose ground is known. Left out are returns over ground whose
// standard error is larger than 5 cm, or than 1.5 times the plot's median where that is more, and
// places where a ridge was cut off: there the lowest returns and the highest both stand out of
// those of the plot's other places, as no plant makes them, or the highest do beside such a place;
// more than a quarter of the plot is no ridge.
// Own choice, docs/plot-heights.md.
KnownReturns known_returns(const PlotBox& box, std::span<const Eigen::Vector3f> points,
                           const ground::Surface& surface);

}  // namespace plotscan::heights
