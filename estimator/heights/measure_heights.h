// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "ground/surface.h"

namespace plotscan::heights {

// One height of a plot with its uncertainty, metres.
struct Height {
  double value_m = 0;
  double standard_error_m = 0;
  double low95_m = 0;
  double high95_m = 0;
};

// What is known of one plot's heights.
struct PlotHeights {
  std::map<std::string, Height> heights = {};  // "mean", "max", "p50", "p90", "p95", "p99", ...
  std::vector<std::string> flags = {};  // why the plot should not be trusted; empty when it may be
  std::size_t points = 0;               // returns in its box
};

// One plot as it is measured: its box, and the points (x, y, height above the ground) in it.
struct PlotPoints {
  PlotBox box;
  std::span<const Eigen::Vector3f> points;
};

struct HeightOptions {
  bool calibrated = true;  // plants' heights from the canopy's; false: the canopy's own quantiles
  std::optional<std::string> crop = std::nullopt;  // as the calibration names it, where known
  int threads = 1;
};

// The names of the crops that may be given.
const std::vector<std::string>& crop_names();

// The heights of a field's plots, in their order, and how likely the field is of each crop.
struct FieldHeights {
  std::vector<PlotHeights> plots = {};
  std::map<std::string, double> crops = {};  // how likely each is; empty without calibration
};

// Boxes, points' x and y, and the surface are in one frame, metres. A plot without points has no
// heights. Throws InputError on an unknown crop, where there are points and the calibration is
// used.
FieldHeights measure_heights(std::span<const PlotPoints> plots, const ground::Surface& surface,
                             const HeightOptions& options);

}  // namespace plotscan::heights
