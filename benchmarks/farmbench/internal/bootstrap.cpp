// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/bootstrap.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "core/statistics.h"

namespace plotscan::farmbench {
namespace {

bool can_resample(const std::vector<SquaredErrors>& farms) {
  return std::ranges::count_if(farms, [](const SquaredErrors& f) { return f.count > 0; }) >= 2;
}

// The errors of the farms drawn in one resample.
SquaredErrors drawn(const std::vector<SquaredErrors>& farms, std::uint64_t seed,
                    std::size_t resample) {
  RandomStream random(seed, random_purpose("farmbench/bootstrap"), resample);
  SquaredErrors sum;
  for (std::size_t i = 0; i < farms.size(); ++i) {
    const SquaredErrors& farm = farms[random.below(farms.size())];
    sum.sum += farm.sum;
    sum.count += farm.count;
  }
  return sum;
}

Interval interval_of(const std::vector<double>& values) {
  return {quantile(values, 0.025), quantile(values, 0.975)};
}

}  // namespace

double rmse(const SquaredErrors& errors) {
  return errors.count == 0 ? kNaN : std::sqrt(errors.sum / static_cast<double>(errors.count));
}

Interval bootstrap_rmse(const std::vector<SquaredErrors>& farms, std::uint64_t seed) {
  if (!can_resample(farms)) return {kNaN, kNaN};
  std::vector<double> rmses;
  for (std::size_t resample = 0; resample < kResamples; ++resample) {
    const SquaredErrors errors = drawn(farms, seed, resample);
    if (errors.count > 0) rmses.push_back(rmse(errors));
  }
  return interval_of(rmses);
}

Interval bootstrap_rmse_change(const std::vector<SquaredErrors>& before,
                               const std::vector<SquaredErrors>& after, std::uint64_t seed) {
  check(before.size() == after.size(), "both hold the same farms");
  if (!can_resample(before) || !can_resample(after)) return {kNaN, kNaN};
  std::vector<double> changes;
  for (std::size_t resample = 0; resample < kResamples; ++resample) {
    const SquaredErrors errors_before = drawn(before, seed, resample);
    const SquaredErrors errors_after = drawn(after, seed, resample);
    if (errors_before.count > 0 && errors_after.count > 0)
      changes.push_back(rmse(errors_after) - rmse(errors_before));
  }
  return interval_of(changes);
}

}  // namespace plotscan::farmbench
