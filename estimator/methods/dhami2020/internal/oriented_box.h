// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::methods::dhami2020 {

// The rectangle of least area around the points, its length the longer side, its heading in
// [0, pi): one side of it lies along an edge of the hull (Freeman and Shapira, 1975). Zero sides
// where the points are one or on one line.
PlotBox minimum_area_box(std::vector<Eigen::Vector2d> points);

}  // namespace plotscan::methods::dhami2020
