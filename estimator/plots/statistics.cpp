// SPDX-License-Identifier: Apache-2.0
#include "plots/statistics.h"

#include <algorithm>

namespace plotscan::plots {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double usual_step(std::vector<double> steps) {
  if (steps.empty()) return 0;
  std::ranges::sort(steps);
  const double low = steps[steps.size() / 4];
  std::erase_if(steps, [&](double step) { return step > 1.3 * low; });
  return median(steps);
}

}  // namespace plotscan::plots
