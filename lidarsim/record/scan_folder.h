// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include <Eigen/Geometry>

#include "core/geodesy.h"
#include "core/utc_time.h"
#include "record/velodyne/packet.h"
#include "scan/trajectory.h"
#include "sensor/sensor.h"
#include "sensor/shots.h"

namespace plotscan::record {

// What is known of a flight beside its points: enough to turn each point back into the range that
// the sensor measured, and to say when and where on Earth that was.
struct FlightRecord {
  sensor::Sensor sensor;
  double spin_hz = 10;                         // 0 of a sensor that does not spin
  Eigen::Isometry3d body_from_lidar;           // as stated; the true one may differ
  scan::Trajectory reported;                   // what places the points
  UtcTime start;                               // at time 0 of the points and the trajectory
  std::optional<Anchor> anchor = {};           // of the world frame's origin
  ReturnMode returns = ReturnMode::strongest;  // what the sensor reports of a shot
  sensor::SpinJitter spin_jitter = {};

  // The shots as the points were placed.
  sensor::ShotPlan placed() const {
    return {sensor, spin_hz, body_from_lidar, reported, spin_jitter};
  }
};

// body_from_lidar = Rz(yaw) Ry(pitch) Rx(roll) of (roll, pitch, yaw).
Eigen::Isometry3d mount_pose(const Eigen::Vector3d& rpy_rad);

// Reads a scan folder (docs/scan-format.md) but for its cloud. Throws InputError when the folder
// is none, or a file is missing or broken.
FlightRecord read_flight_record(const std::filesystem::path& scan_folder);

}  // namespace plotscan::record
