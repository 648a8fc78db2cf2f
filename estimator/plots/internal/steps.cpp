// SPDX-License-Identifier: Apache-2.0
#include "plots/internal/steps.h"

#include "core/statistics.h"

namespace plotscan::plots {

double usual_step(std::vector<double> steps) {
  if (steps.empty()) return 0;
  const double most = 1.3 * quantile(steps, 0.25);
  std::erase_if(steps, [&](double step) { return step > most; });
  return quantile(std::move(steps), 0.5);
}

double parabola_top(double before, double middle, double after) {
  const double bend = before - 2 * middle + after;
  return bend < 0 ? 0.5 * (before - after) / bend : 0;
}

}  // namespace plotscan::plots
