// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "flight/route.h"

namespace plotscan::flight {

// One entry of a waypoint file (docs/flight.md).
struct StatedWaypoint {
  Waypoint waypoint;                      // its z is set only if there is no altitude_m
  std::optional<double> altitude_m = {};  // above the ground below the waypoint
};

// Throws InputError, naming file and line, on an unknown key, a number out of its range, both or
// neither of z_m and altitude_m, fewer than two waypoints, or a speed at the last one.
std::vector<StatedWaypoint> read_waypoints(const std::filesystem::path& file);

}  // namespace plotscan::flight
