// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <fmt/core.h>

namespace plotscan {

// The closed range of a number.
struct Range {
  double low;
  double high;

  bool contains(double value) const { return value >= low && value <= high; }  // false for NaN
  // "[0, 100000]"
  std::string text() const { return fmt::format("[{:.10g}, {:.10g}]", low, high); }
};

}  // namespace plotscan
