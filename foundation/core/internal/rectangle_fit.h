// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan {

// The rectangle nearest to a polygon.
struct RectangleFit {
  PlotBox box;       // length is the longer side
  double off_m = 0;  // farthest that a corner or any other vertex lies from where it should
};

// Of a ring of vertices, closed or not, either way round, metres. Vertices that bend the outline
// least are left out until four corners are there; the rectangle is the one with the least sum of
// squared distances to these. Nothing when there are fewer than four vertices, or more than 1000.
std::optional<RectangleFit> fit_rectangle(std::vector<Eigen::Vector2d> ring);

// How far off a plot's polygon may be, metres: 0.1, or 3 % of the diagonal where that is more, so
// that corners rounded to decimetres pass; at most a quarter of the width.
double rectangle_tolerance_m(const PlotBox& box);

}  // namespace plotscan
