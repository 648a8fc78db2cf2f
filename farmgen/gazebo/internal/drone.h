// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gazebo/elements.h"
#include "gazebo/export_options.h"
#include "gazebo/plant_models.h"

namespace plotscan::gazebo {

inline constexpr const char* kDroneModel = "drone";

// Writes models/drone: a quadrotor that is moved from outside, with a VLP-16 at its origin mounted
// as lidarsim's (spin axis along x, azimuth 0 down), an IMU and, with `gps`, a GPS receiver. All of
// its body is nearer to the origin than the least range. Gazebo Sim: a static model, which the
// service set_pose moves. Gazebo Classic: kinematic, without gravity; fly_drone.sh makes it an
// actor.
EntityCounts write_drone_model(const ModelFolder& models, Lidar lidar, bool gps);

}  // namespace plotscan::gazebo
