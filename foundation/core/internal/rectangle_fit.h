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
  double off_m = 0;  // greatest distance of a vertex from the rectangle: corners from its corners
};

// Fits a rectangle to a ring of vertices (metres, closed or not, either way round). Vertices that
// bend the outline least are dropped until four corners remain; the rectangle has the least sum of
// squared distances to these. Absent when there are fewer than four vertices, or more than 1000.
std::optional<RectangleFit> fit_rectangle(std::vector<Eigen::Vector2d> ring);

// The greatest RectangleFit::off_m with which a polygon counts as a plot, metres: 0.1, or 3 % of
// the diagonal where that is more, so that corners rounded to decimetres pass; at most a quarter of
// the width.
double rectangle_tolerance_m(const PlotBox& box);

}  // namespace plotscan
