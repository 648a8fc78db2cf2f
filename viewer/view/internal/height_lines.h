// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "estimate/estimate.h"
#include "view/internal/axes.h"
#include "view/internal/ground_profile.h"
#include "view/internal/page.h"

namespace plotscan::view {

// One of a plot's heights with its 95 % interval, metres over the ground.
struct HeightLine {
  std::string name;
  double height_m = 0;
  double low_m = 0;
  double high_m = 0;
  bool has_interval = false;
  Rgb colour = {};
};

// The plot's heights of these names; none named: those of mean, p95 and max that it has, else all
// that it has. Throws InputError naming a height that the plot does not have.
std::vector<HeightLine> height_lines(const estimate::PlotEstimate& plot,
                                     const std::vector<std::string>& names);

// Room that their labels need at the right of the chart.
double labels_width_px(const std::vector<HeightLine>& heights, double text_px);

// The lines over the ground with their intervals, and at the right of the chart their names and
// numbers.
void draw_heights(Page& page, const Axes& axes, const std::vector<ProfilePoint>& ground,
                  const std::vector<HeightLine>& heights, double text_px);

}  // namespace plotscan::view
