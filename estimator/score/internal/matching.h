// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/plot_box.h"

namespace plotscan::score {

// Which estimated plot is which true one.
struct PlotMatch {
  std::size_t truth = 0;     // index of the true plot
  std::size_t estimate = 0;  // index of the estimated plot
  double iou = 0;            // intersection over union of their boxes
};

// One to one: every true plot is in `matches` or `missed`, every estimate in `matches` or `extra`.
struct Matching {
  std::vector<PlotMatch> matches;   // in the order of the true plots
  std::vector<std::size_t> missed;  // true plots without an estimate
  std::vector<std::size_t> extra;   // estimates without a true plot
};

// The pairs of at least min_iou, in the order of the true plots.
std::vector<PlotMatch> overlapping_pairs(const std::vector<PlotBox>& truths,
                                         const std::vector<PlotBox>& estimates, double min_iou);

// Pairs boxes by descending intersection over union, equal ones by their place, and takes those of
// at least min_iou. Where true plots do not overlap and min_iou is over one half, an estimate can
// reach min_iou with one true plot only, so that no other pairing overlaps more in total. Throws
// InputError unless min_iou is over 0 and at most 1.
Matching match_plots(const std::vector<PlotBox>& truths, const std::vector<PlotBox>& estimates,
                     double min_iou);

}  // namespace plotscan::score
