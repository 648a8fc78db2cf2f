// SPDX-License-Identifier: Apache-2.0
#include "core/statistics.h"

#include <cmath>
#include <numeric>

#include "core/error.h"

namespace plotscan {

double quantile(std::vector<double> values, double share) {
  check(share >= 0 && share <= 1, "a quantile's share is in [0, 1]");
  if (values.empty()) return kNaN;
  const double position = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(std::floor(position));
  const double low = selected<double>(values, static_cast<std::size_t>(below));
  const double fraction = position - static_cast<double>(below);
  if (fraction == 0) return low;
  const double high = *std::min_element(values.begin() + below + 1, values.end());
  return low + fraction * (high - low);
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return kNaN;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace plotscan
