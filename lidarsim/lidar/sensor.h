// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plotscan::lidar {

// One laser of a spinning sensor. Lidar frame as in the ROS velodyne driver: x forward at azimuth
// 0, y left, z the spin axis; azimuth grows clockwise seen from +z.
struct Laser {
  double elevation_rad = 0;  // over the x-y plane
  double offset_m = 0;       // of the ray's origin along the spin axis
  double fires_s = 0;        // after the firing sequence's start
  std::uint16_t ring = 0;    // rank by elevation, 0 the lowest
};

// A sensor that spins and fires its lasers one after the other, over and over.
struct SpinningLidar {
  std::string name;
  std::vector<Laser> lasers;  // in the order of firing; at most kMaxLasers
  double sequence_s = 0;      // from one firing sequence to the next
  double min_range_m = 0;
  double max_range_m = 0;
  double range_step_m = 0;  // ranges are multiples of it; 0: not quantised
  double min_spin_hz = 0;
  double max_spin_hz = 0;
};

inline constexpr std::size_t kMaxLasers = 128;

// Velodyne VLP-16 (user manual 63-9243, chapter 9 and appendix on its firing sequence); its least
// range is that of the ROS driver.
SpinningLidar vlp16();

// The sensor called `name`, or InputError naming those there are.
SpinningLidar sensor_named(const std::string& name);

}  // namespace plotscan::lidar
