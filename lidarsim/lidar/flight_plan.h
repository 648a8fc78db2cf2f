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

// Plans flight::strips_over the site's areas. Returns the strips' ends, world frame, metres. Throws
// InputError when the site has no area or no ground under them, the altitude is not 0.5 to 120 m or
// the spacing not 0.1 to 1000 m, the path is longer than 100 km, or anything in the scene within
// half a metre to the side of the path reaches up to its height.
std::vector<Eigen::Vector3d> plan_strips(const Site& site, const Scene& scene,
                                         const flight::StripOptions& options);

// The waypoints of a file (flight::read_waypoints), world frame. Altitudes count from the ground
// below each, the first surface labelled ground from above. Throws InputError, naming the file,
// where read_waypoints does, and when there is no ground below an altitude, a waypoint lies less
// than 0.5 or more than 120 m over its ground or at the same place as the one before it, the path
// is longer than 100 km, or anything within half a metre to its side reaches up to its height.
std::vector<flight::Waypoint> plan_waypoints(const Scene& scene, const std::filesystem::path& file);

// The height of the highest ground below or above the place, whatever grows or stands over it,
// world frame, metres; absent where there is none.
std::optional<double> ground_at(const Scene& scene, const Eigen::Vector3d& place);

}  // namespace plotscan::lidar
