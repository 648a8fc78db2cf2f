// SPDX-License-Identifier: Apache-2.0
// Plots and heights of points that a program of your own holds: field_of_points < POINTS
// The points are lines "x y z" on stdin, metres.
#include <array>
#include <cstdio>
#include <exception>
#include <iostream>
#include <vector>

#include <plotscan/estimate.h>

int main() {
  std::vector<std::array<double, 3>> points;
  for (std::array<double, 3> point; std::cin >> point[0] >> point[1] >> point[2];)
    points.push_back(point);
  try {
    const plotscan::FieldEstimate field = plotscan::estimate_field(plotscan::PointsView(points));
    if (field.plots.empty()) std::printf("no plots: %s\n", field.why_no_plots.c_str());
    for (const plotscan::Plot& plot : field.plots) {
      const plotscan::Height& height = plot.heights.at("max");
      std::printf("plot %s at (%.2f, %.2f): %.3f m, 95 %% in [%.3f, %.3f]\n", plot.id.c_str(),
                  plot.box.center_x_m, plot.box.center_y_m, height.value_m, height.low95_m,
                  height.high95_m);
    }
  } catch (const plotscan::BadInput& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
