// SPDX-License-Identifier: Apache-2.0
#include "score/internal/matching.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/csv.h"
#include "core/error.h"

namespace plotscan::score {
namespace {

double half_diagonal(const PlotBox& box) { return std::hypot(box.width_m, box.length_m) / 2; }

std::vector<std::size_t> by_x(const std::vector<PlotBox>& boxes) {
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return boxes[i].center.x(); });
  return order;
}

std::vector<std::size_t> places_of(const std::vector<bool>& flags, bool value) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i] == value) places.push_back(i);
  }
  return places;
}

}  // namespace

std::vector<PlotMatch> overlapping_pairs(const std::vector<PlotBox>& truths,
                                         const std::vector<PlotBox>& estimates, double min_iou) {
  // Boxes that are far apart along x are not compared.
  const std::vector<std::size_t> order = by_x(estimates);
  double reach_m = 0;
  for (const PlotBox& box : estimates) reach_m = std::max(reach_m, half_diagonal(box));
  const auto x_of = [&](std::size_t i) { return estimates[i].center.x(); };
  std::vector<PlotMatch> pairs;
  for (std::size_t truth = 0; truth < truths.size(); ++truth) {
    const double x = truths[truth].center.x();
    const double far_m = reach_m + half_diagonal(truths[truth]);
    for (auto near = std::ranges::lower_bound(order, x - far_m, {}, x_of);
         near != order.end() && x_of(*near) <= x + far_m; ++near) {
      const double iou = intersection_over_union(truths[truth], estimates[*near]);
      if (iou >= min_iou) pairs.push_back({.truth = truth, .estimate = *near, .iou = iou});
    }
  }
  return pairs;
}

Matching match_plots(const std::vector<PlotBox>& truths, const std::vector<PlotBox>& estimates,
                     double min_iou) {
  if (!(min_iou > 0 && min_iou <= 1)) {
    throw InputError("the least overlap of a found plot is " + format_number(min_iou) +
                     "; it is an intersection over union, over 0 and at most 1");
  }
  std::vector<PlotMatch> pairs = overlapping_pairs(truths, estimates, min_iou);
  std::ranges::sort(pairs, {}, [](const PlotMatch& pair) {
    return std::tuple(-pair.iou, pair.truth, pair.estimate);
  });
  Matching matching;
  std::vector<bool> truth_taken(truths.size());
  std::vector<bool> estimate_taken(estimates.size());
  for (const PlotMatch& pair : pairs) {
    if (truth_taken[pair.truth] || estimate_taken[pair.estimate]) continue;
    truth_taken[pair.truth] = true;
    estimate_taken[pair.estimate] = true;
    matching.matches.push_back(pair);
  }
  std::ranges::sort(matching.matches, {}, &PlotMatch::truth);
  matching.missed = places_of(truth_taken, false);
  matching.extra = places_of(estimate_taken, false);
  return matching;
}

}  // namespace plotscan::score
