// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "score/height_score.h"

namespace plotscan::score {

// The errors of one height against one truth, split into the part that all plots of a farm share
// and the rest within the farm. An error is estimate minus truth. NaN where there is nothing to
// compute it from.
struct WithinFarms {
  std::size_t farms = 0;    // with a plot that has both heights
  double farm_bias_m = 0;   // root mean square, over farms, of each one's mean error
  double worst_bias_m = 0;  // the mean error of the farm where it is furthest from 0
  // Root mean square, over all plots, of the errors less their farm's mean error. With as many
  // plots on each farm, rmse^2 = farm_bias^2 + within^2.
  double within_m = 0;
  // Share of the truths' variance within farms that a line through the estimates explains: the
  // square of Pearson's correlation of both, each less its farm's mean, over all plots. Blind to
  // the farms' biases and to scale. NaN where either is the same all over each farm.
  double r2 = 0;
  // Spearman's rank correlation (equal values share their mean rank), a farm at a time, then the
  // mean over farms weighted by their plots; farms on which either is the same everywhere are left
  // out. Does a method order the plots of a field rightly? 1 is always, 0 no better than chance.
  double rho = 0;
};

// `farms`: the pairs of each farm (height_pairs).
WithinFarms score_within(std::span<const HeightPairs> farms);

// One height against one truth on several farms.
struct HeightOnFarms {
  std::vector<HeightPairs> farms;
  HeightPairs pooled;  // of all farms together
  HeightScore score;   // of these
  WithinFarms within;
};
HeightOnFarms score_on_farms(std::span<const FieldScore> farms, const std::string& height,
                             const std::string& truth);

}  // namespace plotscan::score
