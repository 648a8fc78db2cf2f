// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/angle.h"
#include "lidar/fly.h"
#include "lidarsim/lidar/small_farm.h"
#include "record/scan_folder.h"
#include "temporary_folder.h"

namespace plotscan::testing {

// The records of a cloud.pcd by their place in the file (docs/scan-format.md).
inline std::vector<scan::LabelledPoint> cloud_points(const std::filesystem::path& cloud) {
  std::ifstream in(cloud, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  std::vector<scan::LabelledPoint> points((bytes.size() - 512) / 37);
  const char* at = bytes.data() + 512;
  const auto get = [&at](auto& value) {
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
  };
  for (scan::LabelledPoint& point : points) {
    get(point.x), get(point.y), get(point.z), get(point.intensity), get(point.ring);
    get(point.time), get(point.return_number), get(point.return_count);
    at += 9;  // labels
  }
  return points;
}

// A short flight over the small farm that begins just before a full hour.
struct FlownScan {
  TemporaryFolder folder;
  record::FlightRecord flight;
  std::vector<scan::LabelledPoint> points;

  explicit FlownScan(lidar::FlyOptions options = {}, farm::Farm farm = small_farm())
      : flight(fly(options, farm)) {
    points = cloud_points(folder.path() / "scan" / "cloud.pcd");
  }

 private:
  record::FlightRecord fly(lidar::FlyOptions& options, farm::Farm& farm) const {
    const auto way = folder.path() / "way.txt";
    std::ofstream(way) << "0 -2 0.5 7 0 0 0 1\n0.3 -1.4 0.5 7 0 0 0.02 1\n"
                          "0.75 -0.5 0.6 7.1 0.01 0 0 1\n";
    options.flight = way;
    options.spin_jitter = "none";  // measured() goes by a head that turns steadily
    options.start_utc = "2026-06-01T10:59:59.7Z";
    farm.anchor = Anchor{.latitude_deg = 37.2, .longitude_deg = -80.5, .altitude_m = 610};
    lidar::fly(farm, folder.path() / "scan", options);
    return record::read_flight_record(folder.path() / "scan");
  }
};

// What the sensor measured for a point: from the point, its time and the poses alone.
struct Measured {
  std::uint64_t sequence = 0;
  std::size_t laser = 0;
  double range_m = 0;
  double azimuth_deg = 0;  // of the shot
};

inline std::vector<Measured> measured(const FlownScan& scan) {
  const record::FlightRecord& flight = scan.flight;
  std::vector<Measured> all;
  for (const scan::LabelledPoint& point : scan.points) {
    Measured shot;
    while (flight.sensor.lasers[shot.laser].ring != point.ring) ++shot.laser;
    const sensor::Laser& laser = flight.sensor.lasers[shot.laser];
    shot.sequence = static_cast<std::uint64_t>(
        std::llround((point.time - laser.fires_s) / flight.sensor.sequence_s));
    const Eigen::Isometry3d world_from_lidar =
        flight.reported.world_from_body(point.time) * flight.body_from_lidar;
    const Eigen::Vector3d origin = world_from_lidar * Eigen::Vector3d(0, 0, laser.offset_m);
    shot.range_m = (Eigen::Vector3d(point.x, point.y, point.z) - origin).norm();
    shot.azimuth_deg =
        std::fmod(360 * flight.spin_hz * point.time + degrees(laser.azimuth_rad), 360);
    all.push_back(shot);
  }
  return all;
}

// Between two azimuths, the shorter way round.
inline double azimuth_error_deg(double a_deg, double b_deg) {
  return std::abs(std::remainder(a_deg - b_deg, 360));
}

}  // namespace plotscan::testing
