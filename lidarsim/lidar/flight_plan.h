// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "lidar/scene.h"
#include "lidar/site.h"

namespace plotscan::lidar {

// A lawn-mower path over a site's areas, a farm's plots.
struct FlightPlanOptions {
  double altitude_m = 8;  // over the mean ground under the areas
  double spacing_m = 6;   // between neighbouring strips
  double run_up_m = 1;    // strips reach this far beyond the areas, so that they pass at full speed
};

// The ends of the strips in the order of flight, world frame, metres, all at one height: strips
// along the longer side of the areas' bounding rectangle (its sides along the areas' mean
// direction), spacing_m apart, so many that no point of the rectangle is further than half a
// spacing from one. Throws InputError when the site has no area or no ground under them, an option
// is out of its range, the path is longer than 100 km, or anything of the scene within half a metre
// beside the path reaches up to it.
std::vector<Eigen::Vector3d> plan_strips(const Site& site, const Scene& scene,
                                         const FlightPlanOptions& options);

}  // namespace plotscan::lidar
