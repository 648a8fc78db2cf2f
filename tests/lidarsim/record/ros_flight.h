// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "record/ros/recorder.h"
#include "record/scan_folder.h"

namespace plotscan::testing {

// A circle flown level, nose along the way, counter-clockwise.
struct Circle {
  double radius_m = 2;
  double rate_rad_s = 0.8;
  double height_m = 5;

  Eigen::Vector3d position_m(double time_s) const {
    return {radius_m * std::cos(rate_rad_s * time_s), radius_m * std::sin(rate_rad_s * time_s),
            height_m};
  }
  // Poses so many seconds apart, `count` of them.
  scan::Trajectory flown(double interval_s, int count, double start_s = 0) const {
    std::vector<scan::StampedPose> poses;
    for (int i = 0; i < count; ++i) {
      const double time_s = i * interval_s;
      const Eigen::AngleAxisd yaw(rate_rad_s * time_s + std::numbers::pi / 2,
                                  Eigen::Vector3d::UnitZ());
      poses.push_back({.time_s = start_s + time_s,
                       .position_m = position_m(time_s),
                       .attitude = Eigen::Quaterniond(yaw)});
    }
    return scan::Trajectory(std::move(poses));
  }
};

// 0.55 seconds over the small farm: five turns of the sensor and half a one.
inline record::FlightRecord circle_flight() {
  Eigen::Isometry3d mount = record::mount_pose({0.02, 1.5, -0.03});
  mount.translation() = Eigen::Vector3d(0.1, -0.05, -0.2);
  return {.sensor = sensor::load_sensor("vlp16"),
          .spin_hz = 10,
          .body_from_lidar = mount,
          .reported = Circle().flown(0.01, 56),
          .start = *parse_utc("2026-06-01T10:00:00.250001Z"),
          .anchor = Anchor{.latitude_deg = 37.2, .longitude_deg = -80.5, .altitude_m = 610}};
}

inline Eigen::Vector3d position(const scan::LabelledPoint& point) {
  return {point.x, point.y, point.z};
}

// Where every shot downwards meets the plane z = 0, in ranges of 2 mm; some with two returns to the
// shot, and all with labels.
inline std::vector<scan::LabelledPoint> scanned(const record::FlightRecord& flight) {
  const sensor::ShotPlan plan = flight.placed();
  std::vector<scan::LabelledPoint> points;
  sensor::SequenceShots shots;
  for (std::uint64_t sequence = 0; sequence < plan.sequences(); ++sequence) {
    plan.fire(sequence, shots);
    for (std::size_t laser = 0; laser < plan.lasers(); ++laser) {
      const auto k = static_cast<Eigen::Index>(laser);
      const Eigen::Vector3d origin(shots.origin_m[0][k], shots.origin_m[1][k],
                                   shots.origin_m[2][k]);
      const Eigen::Vector3d direction(shots.direction[0][k], shots.direction[1][k],
                                      shots.direction[2][k]);
      const double range_m = 0.002 * std::round(-origin.z() / direction.z() / 0.002);
      if (!(range_m > 0.4 && range_m < 40)) continue;
      const Eigen::Vector3f place = (origin + range_m * direction).cast<float>();
      const auto n = static_cast<std::uint32_t>(points.size());
      points.push_back({.x = place.x(),
                        .y = place.y(),
                        .z = place.z(),
                        .intensity = static_cast<float>(n % 101),
                        .ring = flight.sensor.lasers[laser].ring,
                        .time = plan.time_s(sequence, laser),
                        .return_number = static_cast<std::uint8_t>(n % 3 == 0 ? 2 : 1),
                        .return_count = static_cast<std::uint8_t>(n % 3 == 0 ? 3 : 1),
                        .label = static_cast<scan::PointClass>(n % 5),
                        .plot = n % 7,
                        .plant = 70'000 + n % 11});
    }
  }
  return points;
}

inline std::unique_ptr<record::ros::FileWriter> create_file(
    const std::filesystem::path& file, std::vector<record::ros::Topic> topics) {
  return (file.extension() == ".bag" ? record::ros::create_bag : record::ros::create_mcap)(
      file, std::move(topics));
}

// The points recorded to a file, by its extension.
inline void record_to(const std::filesystem::path& file, const record::FlightRecord& flight,
                      const std::vector<scan::LabelledPoint>& points,
                      const record::RosRecorderOptions& options = {}) {
  record::RosRecorder recorder(flight, options, [&](std::vector<record::ros::Topic> topics) {
    return create_file(file, std::move(topics));
  });
  // In pieces whose ends are no sweep's.
  for (std::size_t begin = 0; begin < points.size(); begin += 1000) {
    const std::size_t count = std::min<std::size_t>(1000, points.size() - begin);
    recorder.write(std::span(points).subspan(begin, count));
  }
  recorder.close();
}

}  // namespace plotscan::testing
