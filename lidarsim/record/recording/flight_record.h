// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "core/geodesy.h"
#include "core/utc_time.h"
#include "scan/trajectory.h"
#include "sensor/return_mode.h"
#include "sensor/sensor.h"
#include "sensor/shots.h"

namespace plotscan::record {

using sensor::ReturnMode;

// What is known of a flight besides its points. It suffices to turn each point back into the range
// that the sensor measured, and to say when and where on Earth that was.
struct FlightRecord {
  sensor::Sensor sensor;
  double spin_hz = 10;                         // 0 for a sensor that does not spin
  Eigen::Isometry3d body_from_lidar;           // as stated; the true one may differ
  scan::Trajectory reported;                   // the points are placed by it; begins at time 0
  UtcTime start;                               // at time 0 of the points and the trajectory
  std::optional<Anchor> anchor = {};           // of the world frame's origin
  ReturnMode returns = ReturnMode::strongest;  // which returns of a shot it reports
  sensor::SpinJitter spin_jitter = {};

  // The shots by the reported poses and the stated mount, as the points were placed.
  sensor::ShotPlan placed() const {
    return {sensor, spin_hz, body_from_lidar, reported, spin_jitter};
  }
};

// Throws InputError on a point of the flight's time that lies so far outside its trajectory that it
// must be in another time: the poses at the trajectory's ends would be taken for its own.
void require_flown(const FlightRecord& flight, double time_s);

}  // namespace plotscan::record
