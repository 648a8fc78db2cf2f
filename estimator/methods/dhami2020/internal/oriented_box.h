// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::methods::dhami2020 {

// Counter-clockwise corners of the convex hull (Andrew's monotone chain), without points on its
// edges; the points themselves when there are fewer than three different ones.
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);

// The rectangle of least area around the points, its length the longer side, its heading in
// [0, pi): one side of it lies along an edge of the hull (Freeman and Shapira, 1975). Zero sides
// where the points are one or on one line.
PlotBox minimum_area_box(std::vector<Eigen::Vector2d> points);

}  // namespace plotscan::methods::dhami2020
