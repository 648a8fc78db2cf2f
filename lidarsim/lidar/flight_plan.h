// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "farm/farm.h"

namespace plotscan::lidar {

// A lawn-mower path over a farm's plots.
struct FlightPlanOptions {
  double altitude_m = 8;  // over the mean terrain under the plots
  double spacing_m = 6;   // between neighbouring strips
  double run_up_m = 1;    // strips reach this far beyond the plots, so that they pass at full speed
};

// The ends of the strips in the order of flight, world frame, metres, all at one height: strips
// along the longer side of the plots' bounding rectangle (its sides along the plots' mean
// direction), spacing_m apart, so many that no point of the rectangle is further than half a
// spacing from one. Throws InputError when the farm has no plots, an option is out of its range,
// the path is longer than 100 km, or it meets the ground or the tallest plant.
std::vector<Eigen::Vector3d> plan_strips(const farm::Farm& farm, const FlightPlanOptions& options);

}  // namespace plotscan::lidar
