// SPDX-License-Identifier: Apache-2.0
#include "score/height_score.h"

#include <cmath>
#include <limits>

#include "core/statistics.h"

namespace plotscan::score {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Sum of (a - mean a)(b - mean b).
double co_moment(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean(a);
  const double mean_b = mean(b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return sum;
}

double ratio(double numerator, double denominator) {
  return denominator > 0 ? numerator / denominator : kNaN;
}

}  // namespace

std::set<std::string> estimated_heights(const FieldScore& field) {
  std::set<std::string> names;
  for (const PlotScore& plot : field.plots) {
    if (!plot.found) continue;
    for (const auto& [name, height_m] : plot.found->heights_m) names.insert(name);
  }
  return names;
}

std::set<std::string> true_heights(const FieldScore& field) {
  std::set<std::string> names;
  for (const PlotScore& plot : field.plots) {
    for (const auto& [name, height_m] : plot.truth.heights_m) names.insert(name);
  }
  return names;
}

HeightPairs height_pairs(const FieldScore& field, const std::string& height,
                         const std::string& truth) {
  HeightPairs pairs;
  for (const PlotScore& plot : field.plots) {
    if (!plot.found) continue;
    const auto estimated = plot.found->heights_m.find(height);
    const auto known = plot.truth.heights_m.find(truth);
    if (estimated == plot.found->heights_m.end() || known == plot.truth.heights_m.end()) {
      ++pairs.without;
      continue;
    }
    pairs.estimates_m.push_back(estimated->second);
    pairs.truths_m.push_back(known->second);
  }
  return pairs;
}

HeightScore score_height(const std::string& height, const std::string& truth,
                         const HeightPairs& pairs) {
  HeightScore score{.height = height,
                    .truth = truth,
                    .plots = pairs.estimates_m.size(),
                    .without = pairs.without};
  std::vector<double> errors_m, absolute_m, squared_m2;
  for (std::size_t i = 0; i < score.plots; ++i) {
    errors_m.push_back(pairs.estimates_m[i] - pairs.truths_m[i]);
    absolute_m.push_back(std::abs(errors_m.back()));
    squared_m2.push_back(errors_m.back() * errors_m.back());
  }
  const auto count = static_cast<double>(score.plots);
  const double truth_moment = co_moment(pairs.truths_m, pairs.truths_m);
  const double estimate_moment = co_moment(pairs.estimates_m, pairs.estimates_m);
  const double cross_moment = co_moment(pairs.estimates_m, pairs.truths_m);
  score.rmse_m = std::sqrt(mean(squared_m2));
  score.bias_m = mean(errors_m);
  score.mae_m = mean(absolute_m);
  score.standard_error_m = std::sqrt(ratio(co_moment(errors_m, errors_m), (count - 1) * count));
  score.r2 = 1 - ratio(mean(squared_m2) * count, truth_moment);
  score.correlation2 = ratio(cross_moment * cross_moment, truth_moment * estimate_moment);
  return score;
}

std::vector<HeightScore> score_heights(const FieldScore& field) {
  std::vector<HeightScore> scores;
  for (const std::string& height : estimated_heights(field)) {
    for (const std::string& truth : true_heights(field)) {
      scores.push_back(score_height(height, truth, height_pairs(field, height, truth)));
    }
  }
  return scores;
}

}  // namespace plotscan::score
