// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/steps.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "core/statistics.h"

namespace plotscan::plots {

double usual_step(std::vector<double> steps) {
  if (steps.empty()) return 0;
  const double most = 1.3 * quantile(steps, 0.25);
  std::erase_if(steps, [&](double step) { return step > most; });
  return quantile(std::move(steps), 0.5);
}

void fill_in(std::vector<double>& places) {
  constexpr double kTolerance = 0.15;  // of a step
  std::vector<double> steps;
  for (std::size_t i = 1; i < places.size(); ++i) steps.push_back(places[i] - places[i - 1]);
  const double step = usual_step(steps);
  std::vector<double> filled;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double times = i > 0 && step > 0 ? (places[i] - places[i - 1]) / step : 1;
    const double whole = std::round(times);
    if (std::abs(times - whole) < kTolerance) {
      for (int k = 1; k < static_cast<int>(whole); ++k)
        filled.push_back(places[i - 1] + k / whole * (places[i] - places[i - 1]));
    }
    filled.push_back(places[i]);
  }
  places = std::move(filled);
}

double parabola_top(double before, double middle, double after) {
  const double bend = before - 2 * middle + after;
  return bend < 0 ? 0.5 * (before - after) / bend : 0;
}

}  // namespace plotscan::plots
