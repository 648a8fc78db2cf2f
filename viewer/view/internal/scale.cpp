// SPDX-License-Identifier: Apache-2.0
#include "view/internal/scale.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace plotscan::view {
namespace {

double round_step(double least) {
  const double decade = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= least) return factor * decade;
  return 10 * decade;
}

}  // namespace

std::string Ticks::text(double value, double origin) const {
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  const double shown = value - origin;
  const bool zero = std::abs(shown) < step / 2;
  return fmt::format("{:.{}f}", zero ? 0.0 : shown, decimals);
}

Ticks ticks_between(double low, double high, double least_step) {
  Ticks ticks{.step = round_step(least_step)};
  constexpr double kSlack = 1e-6;  // of a step: ends of the axis count as within
  const auto last = static_cast<long long>(std::floor(high / ticks.step + kSlack));
  for (auto i = static_cast<long long>(std::ceil(low / ticks.step - kSlack)); i <= last; ++i)
    ticks.values.push_back(static_cast<double>(i) * ticks.step);
  return ticks;
}

}  // namespace plotscan::view
