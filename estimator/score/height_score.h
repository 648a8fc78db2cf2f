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

// The truth that a height's name refers to: "height_max_m" for "max", "canopy_p95_m" for
// "canopy_p95". Intervals are scored against this one alone.
std::string named_truth(const std::string& height);

// An error beyond this is large.
inline constexpr double kLargeError_m = 0.05;

// How far an estimate's own intervals and flags can be trusted: counts of found plots that have the
// height and the truth.
struct Trust {
  std::size_t intervals = 0;        // with a 95 % interval; 0 where the height is not named so
  std::size_t covered = 0;          // of these, with the truth inside it
  std::size_t flagged = 0;          // with a flag that concerns the height (methods::concerns)
  std::size_t large_unflagged = 0;  // without such a flag, and the error is large
};

// One estimated height beside one true height, plot by plot.
struct HeightPairs {
  std::vector<double> estimates_m;
  std::vector<double> truths_m;
  std::size_t without = 0;  // found plots that lack the estimate or the truth
  Trust trust = {};
};

// The pairs of a field's found plots, in the order of its true plots.
HeightPairs height_pairs(const FieldScore& field, const std::string& height,
                         const std::string& truth);
void append(HeightPairs& all, const HeightPairs& more);

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
  // Share of truths inside the estimate's own 95 % intervals; NaN without intervals, and where the
  // truth is not the one that the height is named after.
  double coverage95 = 0;
  std::size_t flagged = 0;           // plots with a flag that concerns the height
  std::size_t large_unflagged = 0;   // plots without one whose error is beyond kLargeError_m
  double large_unflagged_share = 0;  // of all plots
};

HeightScore score_height(const std::string& height, const std::string& truth,
                         const HeightPairs& pairs);

// Every estimated height of the field against every true one, by name.
std::vector<HeightScore> score_heights(const FieldScore& field);

// The scores of one of a field's trials.
struct TrialScore {
  int trial = 0;          // as its plots say
  std::size_t plots = 0;  // true ones
  std::size_t found = 0;
  std::vector<HeightScore> heights = {};  // as score_heights
};

// Trial by trial, in the order of their numbers; none where all true plots are of one.
std::vector<TrialScore> score_trials(const FieldScore& field);

// Which of an estimate's heights are compared with a truth: the one with its name; else, for
// height_hand3_m, the mean, which is its expected value; where there is no such height, all of
// them.
std::set<std::string> heights_beside(const std::string& truth,
                                     const std::set<std::string>& heights);

// What to tell the user where heights look like centimetres: the median ratio of estimates to the
// truths that they are compared with (heights_beside) is 100 to a factor of 2, or a hundredth; ""
// elsewhere.
std::string unit_hint(const FieldScore& field);

}  // namespace plotscan::score
