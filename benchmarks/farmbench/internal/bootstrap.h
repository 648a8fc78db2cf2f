// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "farmbench/results_table.h"

namespace plotscan::farmbench {

// The squared errors of one farm's plots.
struct SquaredErrors {
  double sum = 0;
  std::size_t count = 0;
};

// Over all plots; NaN where there are none.
double rmse(const SquaredErrors& errors);

// The 95 % percentile bootstrap interval of the root mean squared error over all plots (Efron and
// Tibshirani, An Introduction to the Bootstrap, 1993, chapter 13). Whole farms are drawn, with
// replacement: the plots of a farm share its terrain and its flight, so they are not independent.
// NaN for fewer than two farms with errors. The same farms are drawn for every method, so that
// methods are compared on the same resamples.
Interval bootstrap_rmse(const std::vector<SquaredErrors>& farms, std::uint64_t seed);

// The same interval for the change of the root mean squared error from `before` to `after`, which
// hold the same farms in the same order: farms are drawn in pairs. NaN where either has fewer than
// two farms with errors.
Interval bootstrap_rmse_change(const std::vector<SquaredErrors>& before,
                               const std::vector<SquaredErrors>& after, std::uint64_t seed);

}  // namespace plotscan::farmbench
