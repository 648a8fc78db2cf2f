// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "gazebo/export_options.h"

namespace plotscan::gazebo {

// Writes a POSIX shell script (with awk) that moves the drone of an open world along a scan's
// trajectory.csv, interpolated as lidarsim does, and lets Gazebo run for each pose so long that the
// lidar fires. Gazebo Sim: service set_pose; Classic: the drone as an <actor> along its waypoints.
void write_fly_script(const std::filesystem::path& path, const std::string& world, Gazebo gazebo);

}  // namespace plotscan::gazebo
