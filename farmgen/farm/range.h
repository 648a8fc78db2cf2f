// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace plotscan::farm {

// The closed range of a number.
struct Range {
  double low;
  double high;

  bool contains(double value) const { return value >= low && value <= high; }  // false for NaN
  // "[0, 100000]"
  std::string text() const {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "[%.10g, %.10g]", low, high);
    return buffer.data();
  }
};

}  // namespace plotscan::farm
