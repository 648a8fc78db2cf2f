// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace plotscan::report {

// The number rounded to `count` decimals: a page need not hold more than it shows.
inline double decimals(double number, int count) {
  const double power = std::pow(10.0, count);
  return std::round(number * power) / power;
}

}  // namespace plotscan::report
