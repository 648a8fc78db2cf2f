// SPDX-License-Identifier: Apache-2.0
#include "lidar/sensor.h"

#include <array>
#include <numbers>

#include "core/error.h"

namespace plotscan::lidar {

SpinningLidar vlp16() {
  constexpr std::array<int, 16> elevation_deg = {-15, 1, -13, 3,  -11, 5,  -9, 7,
                                                 -7,  9, -5,  11, -3,  13, -1, 15};
  constexpr std::array<double, 16> vertical_correction_mm = {
      11.2, -0.7, 9.7, -2.2, 8.1, -3.7, 6.6, -5.1, 5.1, -6.6, 3.7, -8.1, 2.2, -9.7, 0.7, -11.2};
  constexpr double kFiring_s = 2.304e-6;
  SpinningLidar sensor{.name = "vlp16",
                       .lasers = {},
                       .sequence_s = 55.296e-6,  // 16 firings and 18.432 us of recharge
                       .min_range_m = 0.4,
                       .max_range_m = 100,
                       .range_step_m = 0.002,
                       .min_spin_hz = 5,
                       .max_spin_hz = 20};
  for (std::size_t id = 0; id < elevation_deg.size(); ++id) {
    sensor.lasers.push_back({.elevation_rad = elevation_deg[id] * std::numbers::pi / 180,
                             .offset_m = 1e-3 * vertical_correction_mm[id],
                             .fires_s = kFiring_s * static_cast<double>(id),
                             .ring = static_cast<std::uint16_t>((elevation_deg[id] + 15) / 2)});
  }
  return sensor;
}

SpinningLidar sensor_named(const std::string& name) {
  if (name == "vlp16") return vlp16();
  throw InputError("sensor \"" + name + "\" is unknown; there is vlp16");
}

}  // namespace plotscan::lidar
