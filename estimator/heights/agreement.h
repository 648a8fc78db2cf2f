// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "heights/measure_heights.h"

namespace plotscan::heights {

// A plot's height as it was estimated from the cloud, and as people measured it in the field.
struct MeasuredPair {
  Height estimated;
  double measured_m = 0;
};

// How the heights of one field relate to those measured by hand: by one factor. A field's error is
// mostly one number, the step from its canopy to its plants, which is a ratio (ratio_model.h).
struct Agreement {
  std::size_t plots = 0;
  double factor = 1;      // of a measured height to an estimated one
  double factor_sd = 0;   // its posterior standard deviation
  double residual_m = 0;  // standard deviation of a plot's height about factor x estimate
  double t95 = 0;         // half of a 95 % interval in standard deviations
};

// Fewer plots would say more of the plants that happened to be measured than of the field.
inline constexpr std::size_t kLeastMeasured = 5;

// The factor's posterior under a normal prior about 1, as wide as the estimates' own standard
// errors: least squares through the origin, shrunk (Gelman et al., Bayesian Data Analysis, 3rd
// ed., 2.5). The residual variance is the pairs', drawn to a prior of kPriorDegrees degrees of
// freedom (2.6, the scaled inverse chi-squared), and is then taken as known but for Student's t.
// Takes kLeastMeasured pairs or more, heights and standard errors above 0.
Agreement agreement(std::span<const MeasuredPair> pairs);

// An estimated height as it agrees with those measured, with its new interval.
Height agreed(const Agreement& agreement, const Height& estimated);

}  // namespace plotscan::heights
