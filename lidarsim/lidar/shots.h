// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "lidar/sensor.h"
#include "scan/trajectory.h"

namespace plotscan::lidar {

// The shots of one firing sequence in the world frame, in the order of firing; arrays by component
// so that the compiler works on several lasers at once.
struct SequenceShots {
  using PerLaser = std::array<double, kMaxLasers>;
  std::array<PerLaser, 3> origin_m;
  std::array<PerLaser, 3> direction;  // unit vectors
};

// Every shot of a flight: laser k of firing sequence n is fired n * sequence_s + fires_s(k) seconds
// after the trajectory's start, from where the sensor is at that instant, at the azimuth
// 360 degrees * spin * time.
class ShotPlan {
 public:
  ShotPlan(const SpinningLidar& sensor, double spin_hz, const Eigen::Isometry3d& body_from_lidar,
           const scan::Trajectory& trajectory);

  // Whole firing sequences within the trajectory.
  std::uint64_t sequences() const { return sequences_; }
  std::size_t lasers() const { return lasers_.size(); }
  // Seconds from the trajectory's start.
  double time_s(std::uint64_t sequence, std::size_t laser) const {
    return static_cast<double>(sequence) * sequence_s_ + lasers_[laser].fires_s;
  }
  void fire(std::uint64_t sequence, SequenceShots& shots) const;

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
  // What does not change from sequence to sequence.
  struct LaserConstants {
    double fires_s = 0;
    double cos_elevation = 0;
    double sin_elevation = 0;
    double cos_advance = 0;  // of the azimuth from the sequence's start to this shot
    double sin_advance = 0;
    Eigen::Vector3d origin_m;  // lidar frame's axes, from the body's origin
  };

  const Segment& segment(double time_s) const;
  void fire_lasers(const Segment& motion, double time_s, std::size_t begin, std::size_t end,
                   SequenceShots& shots) const;

  std::vector<LaserConstants> lasers_;
  std::vector<Segment> segments_;
  double sequence_s_ = 0;
  double spin_hz_ = 0;
  std::uint64_t sequences_ = 0;
};

}  // namespace plotscan::lidar
