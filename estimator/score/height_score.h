// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "score/score.h"

namespace plotscan::score {

// The names of all heights that any plot of the field has.
std::set<std::string> estimated_heights(const FieldScore& field);
std::set<std::string> true_heights(const FieldScore& field);

// One estimated height beside one true height, plot by plot.
struct HeightPairs {
  std::vector<double> estimates_m;
  std::vector<double> truths_m;
  std::size_t without = 0;  // found plots that lack the estimate or the truth
};

// The pairs of a field's found plots, in the order of its true plots.
HeightPairs height_pairs(const FieldScore& field, const std::string& height,
                         const std::string& truth);

// Errors are estimate minus truth. What cannot be computed (no plots; one plot for the standard
// error; truths all equal for r2) is NaN.
struct HeightScore {
  std::string height;  // "raw-p99"
  std::string truth;   // "height_max_m"
  std::size_t plots = 0;
  std::size_t without = 0;
  double rmse_m = 0;            // root of the mean squared error
  double bias_m = 0;            // mean error
  double mae_m = 0;             // mean absolute error
  double standard_error_m = 0;  // of the mean error: the errors' standard deviation / sqrt(plots)
  // 1 - SSE / SST against the line estimate = truth (the coefficient of determination): 1 is
  // perfect, 0 is no better than the mean truth for every plot, below 0 is worse.
  double r2 = 0;
  double correlation2 = 0;  // Pearson's r, squared: blind to bias and scale
};

HeightScore score_height(const std::string& height, const std::string& truth,
                         const HeightPairs& pairs);

// Every estimated height of the field against every true one, by name.
std::vector<HeightScore> score_heights(const FieldScore& field);

}  // namespace plotscan::score
