// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "score/height_score.h"

namespace plotscan::score {

// Sums of products over pairs (a, b) after each mean is subtracted.
struct Moments {
  double aa = 0;
  double ab = 0;
  double bb = 0;

  Moments& operator+=(const Moments& more);
  bool vary() const { return aa > 0 && bb > 0; }
  double correlation() const;  // NaN unless both vary
};

// `a` and `b` have equal length. If all values are equal, the moments are exactly 0, even if their
// mean is rounded.
Moments moments(const std::vector<double>& a, const std::vector<double>& b);

// Estimates minus truths.
std::vector<double> errors_of(const HeightPairs& pairs);

}  // namespace plotscan::score
