// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace plotscan {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The share-quantile (0..1) of the values, linear between order statistics (Hyndman and Fan's type
// 7, NumPy's and R's default). NaN when there are none.
double quantile(std::vector<double> values, double share);

// The value that `place` others come before in ascending order, below values.size(): the least at
// 0, the upper median at half. Changes the order.
template <class Value>
Value selected(std::span<Value> values, std::size_t place) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The same for a place near the least, at hardly more than a comparison a value.
template <class Value>
Value selected_low(std::span<Value> values, std::size_t place) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::partial_sort(values.begin(), at + 1, values.end());
  return *at;
}

// The median of values that each count as much as they are: of the counts of points in squares,
// that of the square in which the middle point lies. Of values of at least 0; 0 when there are
// none.
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

// NaN of a whole that is none.
inline double ratio(double part, double whole) { return whole > 0 ? part / whole : kNaN; }

// NaN when there are none.
double mean(const std::vector<double>& values);

}  // namespace plotscan
