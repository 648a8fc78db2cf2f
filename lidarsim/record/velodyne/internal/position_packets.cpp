// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/internal/position_packets.h"

#include <cmath>

#include "core/angle.h"
#include "record/velodyne/encoder.h"

namespace plotscan::record {

GpsFix gps_fix(const FlightRecord& flight, UtcTime second) {
  GpsFix fix{.time = second};
  if (!flight.anchor) return fix;
  const scan::Trajectory& trajectory = flight.reported;
  const double time_s =
      trajectory.start_s() + 1e-6 * static_cast<double>((second - flight.start).count());
  fix.position =
      geodetic_from_world(*flight.anchor, trajectory.world_from_body(time_s).translation());
  if (time_s < trajectory.start_s() || time_s > trajectory.end_s()) return fix;
  const std::size_t i = trajectory.segment(time_s);
  const scan::StampedPose& from = trajectory.poses()[i];
  const scan::StampedPose& to = trajectory.poses()[i + 1];
  const Eigen::Vector3d velocity_m_s =
      (to.position_m - from.position_m) / (to.time_s - from.time_s);
  fix.speed_m_s = velocity_m_s.head<2>().norm();
  const double track_rad = std::atan2(velocity_m_s.x(), velocity_m_s.y());
  fix.track_deg = degrees(track_rad < 0 ? track_rad + 2 * kPi : track_rad);
  return fix;
}

PositionPacket position_packet(const FlightRecord& flight, double time_s) {
  const UtcTime now = later(flight.start, time_s);
  return {.past_hour_us = past_hour_us(now),
          .pps = PpsStatus::locked,
          .sentence = gprmc(gps_fix(flight, std::chrono::floor<std::chrono::seconds>(now)))};
}

}  // namespace plotscan::record
