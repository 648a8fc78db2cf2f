// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "scan/trajectory.h"
#include "sensor/risley.h"
#include "sensor/sensor.h"

namespace plotscan::sensor {

// The shots of one firing sequence in the world frame.
struct SequenceShots {
  VectorPerLaser origin_m;
  VectorPerLaser direction;  // unit vectors
};

// A head that does not spin steadily. At the beginning of each block of kJitterFirings firings its
// azimuth is off that of a steady spin by an independent normal number; in between, the error is
// interpolated linearly. docs/sensors.md tells what was measured.
struct SpinJitter {
  double sd_rad = 0;
  std::uint64_t seed = 0;
};
inline constexpr std::size_t kJitterFirings = 32;  // a block of Velodyne's packets

// Every shot of a flight: laser k of firing sequence n is fired n * sequence time + fires_s(k)
// seconds after the trajectory's start, from where the sensor is at that instant. The head's
// azimuth is then 360 degrees * spin * time plus the jitter at the sequence's start; the beam's is
// that plus the laser's own azimuth. A Risley scanner's beam points to where its prisms send it at
// that instant.
class ShotPlan {
 public:
  ShotPlan(const Sensor& sensor, double spin_hz, const Eigen::Isometry3d& body_from_lidar,
           const scan::Trajectory& trajectory, const SpinJitter& jitter = {});

  // The number of whole firing sequences within the trajectory.
  std::uint64_t sequences() const { return sequences_; }
  std::size_t lasers() const { return static_cast<std::size_t>(fires_s_.size()); }
  // Seconds from the trajectory's start.
  double time_s(std::uint64_t sequence, std::size_t laser) const {
    return static_cast<double>(sequence) * sequence_s_ + fires_s_[static_cast<Eigen::Index>(laser)];
  }
  void fire(std::uint64_t sequence, SequenceShots& shots) const;
  // The head's azimuth when the sequence starts, in turns, 0 to 1.
  double head_turns(std::uint64_t sequence) const;
  // The lidar's z axis in the world when the sequence starts.
  Eigen::Vector3d spin_axis(std::uint64_t sequence) const;

 private:
  // Steady motion between two poses of the trajectory.
  struct Segment {
    double start_s = 0;  // from the trajectory's start
    double end_s = 0;
    Eigen::Vector3d position_m;        // of the body, world frame, at start_s
    Eigen::Vector3d velocity_m_s;      // world frame
    Eigen::Matrix3d world_from_lidar;  // at start_s
    Eigen::Vector3d turn_rad_s;        // lidar frame
  };
  const Segment& segment(double time_s) const;
  VectorPerLaser spun_directions(double cos_azimuth, double sin_azimuth, Eigen::Index begin,
                                 Eigen::Index count) const;
  void fire_lasers(const Segment& motion, std::uint64_t sequence, Eigen::Index begin,
                   Eigen::Index count, SequenceShots& shots) const;
  double jitter_turns(std::uint64_t sequence) const;

  // What does not change from sequence to sequence, for each laser: when it fires after the
  // sequence's start, its direction at azimuth 0, how far its beam's azimuth is then ahead, and the
  // ray's origin relative to the body's, in the lidar frame's axes, without the part that turns
  // with the head.
  PerLaser fires_s_;
  PerLaser cos_elevation_;
  PerLaser sin_elevation_;
  PerLaser cos_advance_;
  PerLaser sin_advance_;
  VectorPerLaser lever_m_;
  // For lasers off the spin axis: radius times cosine and sine of the head's turn until the laser
  // fires. Empty if all are on the axis.
  PerLaser radius_cos_m_;
  PerLaser radius_sin_m_;
  std::optional<Risley> risley_;
  std::vector<Segment> segments_;
  double sequence_s_ = 0;
  double spin_hz_ = 0;
  SpinJitter jitter_;
  std::uint64_t jitter_sequences_ = 1;  // sequences in a block
  std::uint64_t sequences_ = 0;
};

}  // namespace plotscan::sensor
