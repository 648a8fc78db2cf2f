// SPDX-License-Identifier: Apache-2.0
#include "plots/bands.h"

#include <algorithm>
#include <cstddef>

namespace plotscan::plots {

std::vector<double> steps_of(const std::vector<double>& profile, int reach) {
  const int cells = static_cast<int>(profile.size());
  std::vector<double> sums(profile.size() + 1, 0);
  for (std::size_t i = 0; i < profile.size(); ++i) sums[i + 1] = sums[i] + profile[i];
  const auto sum = [&](int begin, int end) {
    return sums[static_cast<std::size_t>(std::clamp(end, 0, cells))] -
           sums[static_cast<std::size_t>(std::clamp(begin, 0, cells))];
  };
  std::vector<double> steps(profile.size() + 1);
  for (int i = 0; i <= cells; ++i) {
    steps[static_cast<std::size_t>(i)] = (sum(i, i + reach) - sum(i - reach, i)) / reach;
  }
  return steps;
}

Bands best_bands(const std::vector<double>& steps, int width, const BandSearch& search) {
  const int ends = static_cast<int>(steps.size());
  std::vector<double> best(steps.size(), 0);
  std::vector<int> chosen(steps.size(), 0);  // width of the band that ends here, 0 for none
  const auto contrast = [&](int begin, int end) {
    return std::min(steps[static_cast<std::size_t>(begin)], -steps[static_cast<std::size_t>(end)]);
  };
  for (int end = 1; end < ends; ++end) {
    const auto at = static_cast<std::size_t>(end);
    best[at] = best[at - 1];
    if (-steps[at] <= search.penalty) continue;
    for (int w = width - search.tolerance; w <= width + search.tolerance; ++w) {
      const int begin = end - w;
      if (w < 1 || begin < 0) continue;
      const double gain = contrast(begin, end) - search.penalty;
      if (gain <= 0) continue;
      const int before = begin - search.least_gap;
      const double total = gain + (before > 0 ? best[static_cast<std::size_t>(before)] : 0);
      if (total > best[at]) {
        best[at] = total;
        chosen[at] = w;
      }
    }
  }
  Bands found;
  found.score = best.empty() ? 0 : best.back();
  for (int end = ends - 1; end > 0;) {
    const int w = chosen[static_cast<std::size_t>(end)];
    if (w == 0) {
      --end;
      continue;
    }
    found.bands.push_back({end - w, end, contrast(end - w, end)});
    end -= w + search.least_gap;
  }
  std::ranges::reverse(found.bands);
  return found;
}

}  // namespace plotscan::plots
