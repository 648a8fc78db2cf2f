// SPDX-License-Identifier: Apache-2.0
#pragma once

// Trials beside each other on one field (docs/plot-finding.md, step 12).

#include <cstddef>
#include <vector>

#include "plots/search/internal/trial_search.h"

namespace plotscan::plots {

// Plots of a trial beside others: fewer may be anything.
inline constexpr std::size_t kLeastOfTrial = 4;

// A trial, and the ground that it takes.
struct SeenTrial {
  std::vector<PlotBox> area;
  Look look = {};
};

// The number of plots of all, each times its field's confidence.
double expected_plots(const std::vector<SeenTrial>& trials);

// The trials that explain the field best, of those that the looks may be the first of. Each is a
// field of plots with all others taken away. None where there are not two, or where no look shows
// one clearly: bushes and sheets have many pieces that might be one.
std::vector<SeenTrial> trials_beside(const ScannedField& field, const Looks& looks);

}  // namespace plotscan::plots
