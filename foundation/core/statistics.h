// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace plotscan {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The quantile of the values at `share` (0 to 1), linear between order statistics (Hyndman and
// Fan's type 7, NumPy's and R's default). NaN if there are no values.
double quantile(std::vector<double> values, double share);

// The value at index `place` (from 0) in ascending order: 0 gives the least value, values.size() /
// 2 the upper median. `place` must be below values.size(). Reorders the values.
template <class Value>
Value selected(std::span<Value> values, std::size_t place) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// As selected, but faster for a small `place`: it needs little more than one comparison per value.
template <class Value>
Value selected_low(std::span<Value> values, std::size_t place) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::partial_sort(values.begin(), at + 1, values.end());
  return *at;
}

// The median of values (at least 0), each weighted by itself. For the numbers of points in squares:
// the number in the square that holds the middle point. 0 if there are no values.
template <class Value>
Value self_weighted_median(std::vector<Value> values) {
  std::ranges::sort(values);
  double all = 0;
  for (const Value value : values) all += static_cast<double>(value);
  double below = 0;
  for (const Value value : values) {
    below += static_cast<double>(value);
    if (2 * below >= all) return value;
  }
  return Value{};
}

// part / whole; NaN unless the whole is above 0.
inline double ratio(double part, double whole) { return whole > 0 ? part / whole : kNaN; }

// NaN when there are none.
double mean(const std::vector<double>& values);

}  // namespace plotscan
