// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plot_box.h"
#include "ground/surface.h"

namespace plotscan::heights {

// What is known of the ground under a plot.
struct PlotGround {
  // Of the ground's mean height: the mean over the measured places of the plot, since their errors
  // are correlated, except for the part that is each cell's own. Metres.
  double standard_error_m = 0;
  double worst_error_m = 0;  // the same about the worst place of what is measured
  double reached_share = 0;  // of the plot that has a ground
  double seen_share = 0;     // of the surface's nodes there: from returns of the ground
  double slope = 0;          // rise over run, root mean square over the plot
};

// Places whose standard error is larger than `largest_error_m` are not measured.
PlotGround ground_under(const PlotBox& box, const ground::Surface& surface, double largest_error_m);

}  // namespace plotscan::heights
