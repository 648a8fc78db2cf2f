// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plotscan::lidar {

// The nearest whole number to a value of at least 0; std::nearbyint would be a library call.
inline double rounded(double value) {
  return static_cast<double>(
      static_cast<std::int64_t>(value + 0.5));  // NOLINT(bugprone-incorrect-roundings)
}

}  // namespace plotscan::lidar
