// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plotscan::scan {

// What a simulated point lies on. The numbers are those written to files.
enum class PointClass : std::uint8_t { unlabelled = 0, ground = 1, crop = 2, weed = 3, other = 4 };

// One return as written by the simulator: the field's PointXYZIRT in the world frame, and labels.
struct LabelledPoint {
  float x = 0, y = 0, z = 0;  // world frame, metres
  float intensity = 0;        // 0..255
  std::uint16_t ring = 0;     // laser by elevation, 0 the lowest
  double time = 0;            // seconds from take-off
  PointClass label = PointClass::unlabelled;
  std::uint32_t plot = 0;   // 0: none
  std::uint32_t plant = 0;  // 0: none
};

}  // namespace plotscan::scan
