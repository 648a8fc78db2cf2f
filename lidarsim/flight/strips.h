// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::flight {

// A lawn-mower path over areas.
struct StripOptions {
  double height_m = 8;   // z of the path, world frame
  double spacing_m = 6;  // between neighbouring strips
  double run_up_m = 1;   // strips reach this far beyond the areas, so that they pass at full speed
};

// The ends of the strips in the order of flight, world frame, metres, all at one height: strips
// along the longer side of the areas' bounding rectangle (its sides along the areas' mean
// direction), spacing_m apart, so many that no point of the rectangle is further than half a
// spacing from one. `areas` holds at least one. Throws InputError when the path is longer than 100
// km.
std::vector<Eigen::Vector3d> strips_over(const std::vector<PlotBox>& areas,
                                         const StripOptions& options);

}  // namespace plotscan::flight
