// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "record/velodyne/packet.h"
#include "scan/point.h"
#include "scan/trajectory.h"
#include "sensor/sensor.h"

namespace plotscan::record {

// How the sensor moved while it recorded.
struct Placement {
  scan::Trajectory world_from_body;  // its first pose is at time 0 of the points
  Eigen::Isometry3d body_from_lidar;
};

// Turns of the head a second while the sensor sent the packet. Azimuths are in steps of 0.01
// degrees, so it is known to a few parts in a thousand: where that is a whole number (the sensors
// are set in steps of 60 turns a minute), the whole number.
double spin_hz(const DataPacket& packet, const sensor::Sensor& sensor);

// Turns data packets into points. A return's point follows from the azimuth, interpolated between
// blocks as the manual says (section 9.5), the laser's own direction and origin, and the time of
// the shot.
class VelodyneDecoder {
 public:
  // Without a placement, each point is in the lidar frame at its own instant.
  VelodyneDecoder(const sensor::Sensor& sensor, std::optional<Placement> placement);

  // Appends the packet's returns in the order of firing; its first firing was at time_s. The nearer
  // of two returns of a shot comes first; two equal returns are one.
  void decode(const DataPacket& packet, double time_s, std::vector<scan::LabelledPoint>& points);

 private:
  // One firing of one laser.
  struct Shot {
    std::size_t laser = 0;
    double head_rad = 0;  // the head's azimuth
    double time_s = 0;
  };

  void add_return(const Shot& shot, PacketReturn measured, int number, int count,
                  std::vector<scan::LabelledPoint>& points) const;

  sensor::Sensor sensor_;
  double distance_step_m_ = 0;
  std::optional<Placement> placement_;
  double last_turn_ = 0;  // 0.01 degrees from block to block, for a packet's last block
};

}  // namespace plotscan::record
