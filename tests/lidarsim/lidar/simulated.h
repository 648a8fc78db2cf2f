// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "farm/farm.h"
#include "lidar/scene.h"
#include "lidar/simulate.h"
#include "sensor/shots.h"

namespace plotscan::testing {

// A VLP-16 whose ranges are neither quantised nor limited.
inline sensor::Sensor exact_vlp16() {
  sensor::Sensor sensor = sensor::load_sensor("vlp16");
  sensor.range_step_m = 0;
  sensor.min_range_m = 0;
  sensor.max_range_m = 1000;
  return sensor;
}

// Spin axis along the flight, azimuth 0 straight down.
inline Eigen::Isometry3d spin_along_flight() {
  return Eigen::Isometry3d(Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitY()));
}

// Still for `duration_s`, level, nose to the east.
inline scan::Trajectory hover(const Eigen::Vector3d& position_m, double duration_s) {
  return scan::Trajectory(
      {{.time_s = 0, .position_m = position_m}, {.time_s = duration_s, .position_m = position_m}});
}

inline std::vector<scan::LabelledPoint> simulated(const farm::Farm& farm,
                                                  const sensor::Sensor& sensor,
                                                  const sensor::ShotPlan& plan,
                                                  const lidar::SimulateOptions& options) {
  std::vector<scan::LabelledPoint> points;
  lidar::simulate(lidar::Scene(lidar::scene_content(farm)), sensor, {.fired = plan, .placed = plan},
                  options, [&](std::span<const scan::LabelledPoint> piece) {
                    points.insert(points.end(), piece.begin(), piece.end());
                  });
  return points;
}

inline Eigen::Vector3d position(const scan::LabelledPoint& point) {
  return {point.x, point.y, point.z};
}

// The number of the shot that made the point, from its time.
inline std::uint64_t shot_of(const scan::LabelledPoint& point) {
  const auto sequence = static_cast<std::uint64_t>(point.time / 55.296e-6 + 0.01);
  const double in_sequence_s = point.time - static_cast<double>(sequence) * 55.296e-6;
  return 16 * sequence + static_cast<std::uint64_t>(std::lround(in_sequence_s / 2.304e-6));
}

// Origin and direction of a shot, world frame.
struct WorldShot {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

inline WorldShot world_shot(const sensor::ShotPlan& plan, std::uint64_t shot) {
  sensor::SequenceShots shots;
  plan.fire(shot / 16, shots);
  const auto k = static_cast<Eigen::Index>(shot % 16);
  return {.origin = {shots.origin_m[0][k], shots.origin_m[1][k], shots.origin_m[2][k]},
          .direction = {shots.direction[0][k], shots.direction[1][k], shots.direction[2][k]}};
}

}  // namespace plotscan::testing
