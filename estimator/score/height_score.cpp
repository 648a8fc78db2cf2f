// SPDX-License-Identifier: Apache-2.0
#include "score/height_score.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "estimate/height_properties.h"
#include "methods/flags.h"
#include "score/internal/moments.h"

namespace plotscan::score {
namespace {

double share(std::size_t part, std::size_t whole) {
  return ratio(static_cast<double>(part), static_cast<double>(whole));
}

bool is_flagged(const FoundPlot& plot, const std::string& height) {
  return std::ranges::any_of(
      plot.flags, [&](const std::string& flag) { return methods::concerns(flag, height); });
}

// `named`: the truth is the one that the height is named after.
void add_trust(Trust& trust, const FoundPlot& plot, const std::string& height, double truth_m,
               bool named) {
  if (is_flagged(plot, height)) {
    ++trust.flagged;
  } else if (std::abs(plot.heights_m.at(height) - truth_m) > kLargeError_m) {
    ++trust.large_unflagged;
  }
  const auto error = plot.errors.find(height);
  if (!named || error == plot.errors.end()) return;
  ++trust.intervals;
  if (truth_m >= error->second.low95_m && truth_m <= error->second.high95_m) ++trust.covered;
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

std::string named_truth(const std::string& height) { return estimate::property_of(height); }

HeightPairs height_pairs(const FieldScore& field, const std::string& height,
                         const std::string& truth) {
  const bool named = named_truth(height) == truth;
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
    add_trust(pairs.trust, *plot.found, height, known->second, named);
  }
  return pairs;
}

void append(HeightPairs& all, const HeightPairs& more) {
  all.estimates_m.insert(all.estimates_m.end(), more.estimates_m.begin(), more.estimates_m.end());
  all.truths_m.insert(all.truths_m.end(), more.truths_m.begin(), more.truths_m.end());
  all.without += more.without;
  all.trust.intervals += more.trust.intervals;
  all.trust.covered += more.trust.covered;
  all.trust.flagged += more.trust.flagged;
  all.trust.large_unflagged += more.trust.large_unflagged;
}

HeightScore score_height(const std::string& height, const std::string& truth,
                         const HeightPairs& pairs) {
  HeightScore score{.height = height,
                    .truth = truth,
                    .plots = pairs.estimates_m.size(),
                    .without = pairs.without};
  const std::vector<double> errors_m = errors_of(pairs);
  std::vector<double> absolute_m, squared_m2;
  for (const double error_m : errors_m) {
    absolute_m.push_back(std::abs(error_m));
    squared_m2.push_back(error_m * error_m);
  }
  const auto count = static_cast<double>(score.plots);
  const Moments both = moments(pairs.estimates_m, pairs.truths_m);
  score.rmse_m = std::sqrt(mean(squared_m2));
  score.bias_m = mean(errors_m);
  score.mae_m = mean(absolute_m);
  score.standard_error_m = std::sqrt(ratio(moments(errors_m, errors_m).aa, (count - 1) * count));
  score.r2 = 1 - ratio(mean(squared_m2) * count, both.bb);
  score.correlation2 = ratio(both.ab * both.ab, both.aa * both.bb);
  score.coverage95 = share(pairs.trust.covered, pairs.trust.intervals);
  score.flagged = pairs.trust.flagged;
  score.large_unflagged = pairs.trust.large_unflagged;
  score.large_unflagged_share = share(score.large_unflagged, score.plots);
  return score;
}

std::set<std::string> heights_beside(const std::string& truth,
                                     const std::set<std::string>& heights) {
  const std::string stated = truth == "height_hand3_m" ? "height_mean_m" : truth;
  for (const std::string& height : heights) {
    if (named_truth(height) == stated) return {height};
  }
  return heights;
}

std::string unit_hint(const FieldScore& field) {
  constexpr double kCentimetres = 100, kWithin = 2;  // times as many, to a factor
  const std::set<std::string> heights = estimated_heights(field);
  std::vector<double> ratios;
  for (const std::string& truth : true_heights(field)) {
    for (const std::string& height : heights_beside(truth, heights)) {
      const HeightPairs pairs = height_pairs(field, height, truth);
      for (std::size_t i = 0; i < pairs.truths_m.size(); ++i)
        if (pairs.truths_m[i] > 0) ratios.push_back(pairs.estimates_m[i] / pairs.truths_m[i]);
    }
  }
  const double times = quantile(ratios, 0.5);
  const auto is_about = [&](double wanted) {
    return times >= wanted / kWithin && times <= wanted * kWithin;
  };
  if (is_about(kCentimetres))
    return "Estimated heights are about 100 times the true ones: are they in centimetres? Files "
           "have metres.";
  if (is_about(1 / kCentimetres))
    return "True heights are about 100 times the estimated ones: are they in centimetres? Files "
           "have metres.";
  return "";
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

std::vector<TrialScore> score_trials(const FieldScore& field) {
  std::map<int, FieldScore> trials;
  for (const PlotScore& plot : field.plots) trials[plot.truth.trial].plots.push_back(plot);
  if (trials.size() < 2) return {};
  std::vector<TrialScore> scores;
  for (const auto& [trial, part] : trials) {
    const auto found = std::ranges::count_if(
        part.plots, [](const PlotScore& plot) { return plot.found.has_value(); });
    scores.push_back({.trial = trial,
                      .plots = part.plots.size(),
                      .found = static_cast<std::size_t>(found),
                      .heights = score_heights(part)});
  }
  return scores;
}

}  // namespace plotscan::score
