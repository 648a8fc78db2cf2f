// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "flight/pose_errors.h"
#include "flight/wind.h"
#include "lidar/fly.h"
#include "lidar/scene.h"
#include "lidar/site.h"
#include "scan/trajectory.h"

namespace plotscan::lidar {

// The drone's way as it was, and as it reports it.
struct DroneFlight {
  scan::Trajectory truth;
  scan::Trajectory reported;
};

// The flight of the options: by a given trajectory, or planned over the site and flown in the wind;
// then reported with the errors. Throws InputError where the flight cannot be flown: an area or
// altitude that is none, something in its way, a wind that the drone does not hold, more than 24
// hours, a broken file.
DroneFlight fly_drone(const Site& site, const Scene& scene, const flight::PoseErrors& errors,
                      const FlyOptions& options);

// The wind of the flight, and whom it moves.
flight::WindOptions wind_of(const FlyOptions& options);
bool wind_moves_drone(const FlyOptions& options);
bool wind_moves_plants(const FlyOptions& options);

}  // namespace plotscan::lidar
