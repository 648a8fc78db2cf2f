// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scan/point.h"

namespace plotscan::scan {

// A point whose every field tells which one it is.
inline LabelledPoint numbered_point(std::uint32_t i) {
  const auto f = static_cast<float>(i);
  return {.x = f,
          .y = -f,
          .z = 0.125f * f,
          .intensity = static_cast<float>(i % 256),
          .ring = static_cast<std::uint16_t>(i % 16),
          .time = 1e-6 * i,
          .return_number = static_cast<std::uint8_t>(1 + i % 2),
          .return_count = static_cast<std::uint8_t>(2 + i % 3),
          .label = static_cast<PointClass>(i % 5),
          .plot = i / 2,
          .plant = 4000000000u + i};
}

inline std::vector<LabelledPoint> numbered_points(std::uint32_t count) {
  std::vector<LabelledPoint> points;
  for (std::uint32_t i = 0; i < count; ++i) points.push_back(numbered_point(i));
  return points;
}

}  // namespace plotscan::scan
