// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "flight/pose_errors.h"
#include "flight/wind.h"
#include "lidar/fly.h"
#include "lidar/scene.h"
#include "lidar/site.h"
#include "scan/trajectory.h"

namespace plotscan::lidar {

// The drone's trajectory as it was flown, and as the drone reports it.
struct DroneFlight {
  scan::Trajectory truth;
  scan::Trajectory reported;
};

// Makes the flight that the options describe: a given trajectory, or one planned over the site and
// flown in the wind. The reported one has the errors. Throws InputError when it cannot be flown: no
// area, an impossible altitude, an obstacle, a wind too strong for the drone, more than 24 hours, a
// broken file.
DroneFlight fly_drone(const Site& site, const Scene& scene, const flight::PoseErrors& errors,
                      const FlyOptions& options);

// The share of the trajectory's poses (of at most a thousand, evenly) that lie below the ground.
double underground(const Scene& scene, const scan::Trajectory& trajectory);

// The wind of the flight, and what it moves.
flight::WindOptions wind_of(const FlyOptions& options);
bool wind_moves_drone(const FlyOptions& options);
bool wind_moves_plants(const FlyOptions& options);

}  // namespace plotscan::lidar
