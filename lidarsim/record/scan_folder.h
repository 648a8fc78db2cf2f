// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include <Eigen/Geometry>

#include "record/recording/flight_record.h"

namespace plotscan::record {

// body_from_lidar = Rz(yaw) Ry(pitch) Rx(roll) of (roll, pitch, yaw).
Eigen::Isometry3d mount_pose(const Eigen::Vector3d& rpy_rad);

// Reads a scan folder (docs/scan-format.md), except for its cloud. Throws InputError when it is no
// scan folder, or a file is missing or broken.
FlightRecord read_flight_record(const std::filesystem::path& scan_folder);

}  // namespace plotscan::record
