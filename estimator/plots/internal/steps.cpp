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

}  // namespace plotscan::plots
