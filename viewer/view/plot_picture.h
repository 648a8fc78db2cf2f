// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/range.h"
#include "estimate/estimate.h"

namespace plotscan::view {

struct PlotPictureOptions {
  static constexpr Range kWidth_px{600, 8192}, kHeight_px{400, 8192}, kBeyond_m{0, 100};

  int width_px = 1600;
  int height_px = 1000;  // at most
  double beyond_m = 1;   // shown before and behind the plot
  // Names of the heights to draw, such as "p95"; empty: those of mean, p95 and max that the plot
  // has, all that it has where it has none of them.
  std::vector<std::string> heights = {};
};

// Draws one plot of an estimate from the side and writes a PNG: distance along its length to the
// right, z upwards (drawn larger where there is room; the picture says how much), the points of the
// cloud (PCD, PLY, LAS) between its long sides, the estimate's ground along its middle (dashed
// where interpolated) within 1.96 standard errors, and its heights over that ground with their 95 %
// intervals. The sight is along the width axis: the plot's length axis points to the right. Needs a
// display as draw_picture does. Throws InputError on options out of range, an estimate without
// ground, a plot or height that it does not have, a cloud that is broken or has no point there, or
// a missing display; WriteError when the file cannot be written.
void draw_plot(const std::filesystem::path& cloud, const estimate::Estimate& estimate,
               const PlotId& plot, const std::filesystem::path& png,
               const PlotPictureOptions& options);

}  // namespace plotscan::view
