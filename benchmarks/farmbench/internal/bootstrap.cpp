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

// The interval of a figure of the resamples, NaN of those that it cannot be computed of.
template <class Figure>
Interval resampled(const Figure& figure) {
  constexpr std::size_t kResamples = 2000;
  std::vector<double> figures;
  for (std::size_t resample = 0; resample < kResamples; ++resample)
    figures.push_back(figure(resample));
  std::erase_if(figures, [](double value) { return std::isnan(value); });
  return {.low = quantile(figures, 0.025), .high = quantile(figures, 0.975)};
}

}  // namespace

double rmse(const SquaredErrors& errors) {
  return errors.count == 0 ? kNaN : std::sqrt(errors.sum / static_cast<double>(errors.count));
}

Interval bootstrap_rmse(const std::vector<SquaredErrors>& farms, std::uint64_t seed) {
  if (!can_resample(farms)) return {};
  return resampled([&](std::size_t resample) { return rmse(drawn(farms, seed, resample)); });
}

Interval bootstrap_rmse_change(const std::vector<SquaredErrors>& before,
                               const std::vector<SquaredErrors>& after, std::uint64_t seed) {
  check(before.size() == after.size(), "both hold the same farms");
  if (!can_resample(before) || !can_resample(after)) return {};
  return resampled([&](std::size_t resample) {
    return rmse(drawn(after, seed, resample)) - rmse(drawn(before, seed, resample));
  });
}

}  // namespace plotscan::farmbench
