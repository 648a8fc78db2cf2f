// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "flight/route.h"
#include "flight/strips.h"
#include "lidar/scene.h"
#include "lidar/site.h"

namespace plotscan::lidar {

// How to fly strips over a site's areas, for example a farm's plots.
struct FlightPlanOptions {
  double altitude_m = 8;  // above the mean ground under the areas, 0.5 to 120
  double spacing_m = 6;   // between neighbouring strips, 0.1 to 1000
  double run_up_m = 1;    // strips reach this far beyond the areas, so that they pass at full speed
  flight::Pattern pattern = flight::Pattern::lawnmower;
  std::optional<double> heading_rad = {};  // of the strips, as in StripOptions
};

// Plans flight::strips_over the site's areas. Returns the strips' ends, world frame, metres. Throws
// InputError when the site has no area or no ground under them, an option is out of its range, the
// path is longer than 100 km, or anything in the scene within half a metre to the side of the path
// reaches up to its height.
std::vector<Eigen::Vector3d> plan_strips(const Site& site, const Scene& scene,
                                         const FlightPlanOptions& options);

// The waypoints of a file (flight::read_waypoints), world frame. Altitudes count from the ground
// below each, the first surface labelled ground from above. Throws InputError, naming the file,
// where read_waypoints does, and when there is no ground below an altitude, a waypoint lies less
// than 0.5 or more than 120 m over its ground or at the same place as the one before it, the path
// is longer than 100 km, or anything within half a metre to its side reaches up to its height.
std::vector<flight::Waypoint> plan_waypoints(const Scene& scene, const std::filesystem::path& file);

// The height of the highest ground below or above the place, whatever grows or stands over it,
// world frame, metres; nothing where there is none.
std::optional<double> ground_at(const Scene& scene, const Eigen::Vector3d& place);

}  // namespace plotscan::lidar
