// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::flight {

enum class Pattern {
  lawnmower,   // parallel strips, flown to and fro
  crosshatch,  // the same, then strips across them
  single       // one strip over the middle
};

// How to lay strips over areas, for example a farm's plots.
struct StripOptions {
  double altitude_m = 8;  // above the ground's height
  double spacing_m = 6;   // between neighbouring strips
  double run_up_m = 1;    // strips reach this far beyond the areas, so that they pass at full speed
  Pattern pattern = Pattern::lawnmower;
  // The strips' heading, counter-clockwise from east. Absent: along the longer side of the areas'
  // bounding rectangle, which is aligned with the areas' mean direction.
  std::optional<double> heading_rad = {};
};

// The ends of the strips in the order of flight, world frame, metres, all altitude_m over the
// ground, whose z is `ground_m`. Strips lie over the areas' bounding rectangle along the strips'
// heading, spacing_m apart: so many that no point of the rectangle is farther than half a spacing
// from a strip (not so for Pattern::single). A crosshatch starts its cross strips at the end nearer
// to the last strip. `areas` must not be empty. Throws InputError when the path is longer than
// kMaxPath_m.
std::vector<Eigen::Vector3d> strips_over(const std::vector<PlotBox>& areas, double ground_m,
                                         const StripOptions& options);

inline constexpr double kMaxPath_m = 100e3;

}  // namespace plotscan::flight
