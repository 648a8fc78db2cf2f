// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plotscan::view {

// Marks of an axis at multiples of a step: 1, 2 or 5 times a power of ten.
struct Ticks {
  double step = 1;
  std::vector<double> values = {};

  // value - origin as text, with the decimals that the step needs.
  std::string text(double value, double origin = 0) const;
};

// Those within [low, high], at least `least_step` apart.
Ticks ticks_between(double low, double high, double least_step);

}  // namespace plotscan::view
