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

// Strips over a site's areas, a farm's plots.
struct FlightPlanOptions {
  double altitude_m = 8;  // over the mean ground under the areas
  double spacing_m = 6;   // between neighbouring strips
  double run_up_m = 1;    // strips reach this far beyond the areas, so that they pass at full speed
  flight::Pattern pattern = flight::Pattern::lawnmower;
  std::optional<double> heading_rad = {};  // of the strips, as StripOptions has it
};

// flight::strips_over the site's areas. Throws InputError when the site has no area or no ground
// under them, an option is out of its range, the path is longer than 100 km, or anything of the
// scene within half a metre beside the path reaches up to it.
std::vector<Eigen::Vector3d> plan_strips(const Site& site, const Scene& scene,
                                         const FlightPlanOptions& options);

// The waypoints of a file (flight::read_waypoints), altitudes counted from the ground below each:
// the first surface labelled ground. Throws InputError, naming the file, where read_waypoints does,
// and when there is no ground below an altitude, a waypoint lies less than 0.5 or more than 120 m
// over its ground or where the one before it does, the path is longer than 100 km, or anything
// within half a metre beside it reaches up to it.
std::vector<flight::Waypoint> plan_waypoints(const Scene& scene, const std::filesystem::path& file);

}  // namespace plotscan::lidar
