// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::heights {

// Share of a plot's area by height: a histogram of the returns' heights above the ground, each
// return weighted by the area it represents.
struct HeightProfile {
  double low_m = 0;                // lower edge of the first bin
  double bin_m = 0;                // width of a bin
  std::vector<double> share = {};  // of the plot's seen area, by height; sums to 1
  std::size_t returns = 0;
  double seen_share = 0;  // of the box's cells that hold a return

  // Height below which this share of the area lies, linear within a bin.
  double quantile(double area_share) const;
  // Share of the area above a height.
  double share_above(double height_m) const;
};

// The profile of the returns (x, y, height above the ground, metres) in a box, in bins of 5 mm.
// Each cell of a grid over the box counts the same however many returns it has, so that strips
// flown twice, or obliquely, do not count twice. `margin_m` is room for noise beyond the lowest and
// the highest return.
HeightProfile height_profile(const PlotBox& box, std::span<const Eigen::Vector3f> points,
                             double margin_m);

}  // namespace plotscan::heights
