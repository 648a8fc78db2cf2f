// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "score/height_score.h"

namespace plotscan::score {

// Sums over pairs (a, b), each less its mean.
struct Moments {
  double aa = 0;
  double ab = 0;
  double bb = 0;

  Moments& operator+=(const Moments& more);
  bool vary() const { return aa > 0 && bb > 0; }
  double correlation() const;  // NaN unless both vary
};

// Of as many a as b. Values that are all equal have moments of exactly 0, whatever their mean
// rounds to.
Moments moments(const std::vector<double>& a, const std::vector<double>& b);

// Estimates less truths.
std::vector<double> errors_of(const HeightPairs& pairs);

}  // namespace plotscan::score
