// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::heights {

// Distances of returns whose heights are compared, metres: from a straw's width to a leaf's.
inline constexpr std::array kLags_m = {0.02, 0.04, 0.08, 0.16};
// Pairs count if both returns are higher than this share of the top: all pairs, the canopy's, its
// upper part's.
inline constexpr std::array<double, 3> kPairsAbove = {-INFINITY, 0.4, 0.7};

// How a canopy's heights differ over short distances: a broad leaf keeps a height that straws lose.
// Semivariance of the heights of returns about a lag apart (0.7 to 1.4 of it, in plan; Matheron,
// Econ. Geol. 58, 1963), without the noise's, over that of 0.32 m; by kPairsAbove, then by kLags_m.
// Between 0 and 1.5; where a lag has too few pairs, that of the next longer one, and 1 for the
// longest. `descending` are the returns (x, y, height above the ground, metres) from the highest to
// the lowest, `noise_m` the sigma of their heights.
std::vector<double> relative_semivariances(const PlotBox& box,
                                           std::span<const Eigen::Vector3f> descending,
                                           double top_m, double noise_m);

// The names of relative_semivariances, in the same order.
std::vector<std::string> semivariance_names();

}  // namespace plotscan::heights
