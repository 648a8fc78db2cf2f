// SPDX-License-Identifier: Apache-2.0
#include "score/within_farms.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/statistics.h"
#include "score/internal/moments.h"

namespace plotscan::score {
namespace {

// Rank of each value, from 1; equal values share the mean of their ranks.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (std::size_t i = first; i < end; ++i)
      ranks[order[i]] = (static_cast<double>(first + 1) + static_cast<double>(end)) / 2;
    first = end;
  }
  return ranks;
}

}  // namespace

WithinFarms score_within(std::span<const HeightPairs> farms) {
  WithinFarms score;
  Moments within;
  double plots = 0, ranked_plots = 0, squared_bias = 0, squared_rest = 0, rho = 0;
  for (const HeightPairs& farm : farms) {
    if (farm.truths_m.empty()) continue;
    const auto count = static_cast<double>(farm.truths_m.size());
    const std::vector<double> errors_m = errors_of(farm);
    const double bias_m = mean(errors_m);
    ++score.farms;
    plots += count;
    squared_bias += bias_m * bias_m;
    squared_rest += moments(errors_m, errors_m).aa;
    if (std::abs(bias_m) > std::abs(score.worst_bias_m)) score.worst_bias_m = bias_m;
    within += moments(farm.estimates_m, farm.truths_m);
    const Moments ranked = moments(ranks(farm.estimates_m), ranks(farm.truths_m));
    if (!ranked.vary()) continue;
    ranked_plots += count;
    rho += count * ranked.correlation();
  }
  if (score.farms == 0) score.worst_bias_m = kNaN;
  score.farm_bias_m =
      score.farms > 0 ? std::sqrt(squared_bias / static_cast<double>(score.farms)) : kNaN;
  score.within_m = plots > 0 ? std::sqrt(squared_rest / plots) : kNaN;
  score.r2 = within.correlation() * within.correlation();
  score.rho = ranked_plots > 0 ? rho / ranked_plots : kNaN;
  return score;
}

HeightOnFarms score_on_farms(std::span<const FieldScore> farms, const std::string& height,
                             const std::string& truth) {
  HeightOnFarms on;
  for (const FieldScore& farm : farms) {
    on.farms.push_back(height_pairs(farm, height, truth));
    append(on.pooled, on.farms.back());
  }
  on.score = score_height(height, truth, on.pooled);
  on.within = score_within(on.farms);
  return on;
}

}  // namespace plotscan::score
