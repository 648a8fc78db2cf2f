// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::flight {

enum class Pattern {
  lawnmower,   // strips to and fro
  crosshatch,  // the same, then strips across them
  single       // one strip over the middle
};

// Strips over areas.
struct StripOptions {
  double height_m = 8;   // z of the path, world frame
  double spacing_m = 6;  // between neighbouring strips
  double run_up_m = 1;   // strips reach this far beyond the areas, so that they pass at full speed
  Pattern pattern = Pattern::lawnmower;
  // Of the strips, counter-clockwise from east; absent: along the longer side of the areas'
  // bounding rectangle, whose sides are along the areas' mean direction.
  std::optional<double> heading_rad = {};
};

// The ends of the strips in the order of flight, world frame, metres, all at one height: strips
// over the areas' bounding rectangle along the strips' heading, spacing_m apart, so many that no
// point of it is further than half a spacing from one (but for the single strip). A crosshatch
// flies the strips across from that end of them which is nearer. `areas` holds at least one. Throws
// InputError when the path is longer than kMaxPath_m.
std::vector<Eigen::Vector3d> strips_over(const std::vector<PlotBox>& areas,
                                         const StripOptions& options);

inline constexpr double kMaxPath_m = 100e3;

}  // namespace plotscan::flight
