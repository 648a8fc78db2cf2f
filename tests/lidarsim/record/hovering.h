// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "record/scan_folder.h"
#include "scan/point.h"

namespace plotscan::testing {

// A sensor that stands still in the world frame's origin, upright and facing east: the lidar frame
// is the world frame.
inline record::FlightRecord hovering(const char* sensor, double duration_s) {
  return {.sensor = sensor::load_sensor(sensor),
          .spin_hz = 10,
          .body_from_lidar = Eigen::Isometry3d::Identity(),
          .reported = scan::Trajectory({{.time_s = 0}, {.time_s = duration_s}}),
          .start = *parse_utc("2026-06-01T10:00:00Z")};
}

// What a return of the shot says, by the closed form of docs/scan-format.md.
inline scan::LabelledPoint return_of(const record::FlightRecord& flight, std::uint64_t sequence,
                                     std::size_t laser, double range_m, float intensity = 50) {
  const sensor::Laser& fired = flight.sensor.lasers[laser];
  const double time_s = static_cast<double>(sequence) * flight.sensor.sequence_s + fired.fires_s;
  const double azimuth = 2 * std::numbers::pi * flight.spin_hz * time_s;
  const double level_m = range_m * std::cos(fired.elevation_rad);
  return {.x = static_cast<float>(level_m * std::cos(azimuth)),
          .y = static_cast<float>(-level_m * std::sin(azimuth)),
          .z = static_cast<float>(fired.offset_m + range_m * std::sin(fired.elevation_rad)),
          .intensity = intensity,
          .ring = fired.ring,
          .time = time_s};
}

}  // namespace plotscan::testing
