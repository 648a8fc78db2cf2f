// SPDX-License-Identifier: Apache-2.0
#include "farmbench/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "core/statistics.h"

namespace plotscan::farmbench {

Interval bootstrap_rmse(const std::vector<SquaredErrors>& farms, std::uint64_t seed) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const auto has_errors = [](const SquaredErrors& farm) { return farm.count > 0; };
  if (std::ranges::count_if(farms, has_errors) < 2) return {kNaN, kNaN};
  std::vector<double> rmses;
  for (std::size_t resample = 0; resample < kResamples; ++resample) {
    RandomStream random(seed, random_purpose("farmbench/bootstrap"), resample);
    SquaredErrors drawn;
    for (std::size_t i = 0; i < farms.size(); ++i) {
      const SquaredErrors& farm = farms[random.below(farms.size())];
      drawn.sum += farm.sum;
      drawn.count += farm.count;
    }
    if (drawn.count > 0) rmses.push_back(std::sqrt(drawn.sum / static_cast<double>(drawn.count)));
  }
  return {quantile(rmses, 0.025), quantile(rmses, 0.975)};
}

}  // namespace plotscan::farmbench
