// SPDX-License-Identifier: Apache-2.0
#include "score/internal/moments.h"

#include <algorithm>
#include <cmath>

#include "core/list_of.h"
#include "core/statistics.h"

namespace plotscan::score {
namespace {

std::vector<double> less_mean(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [low, high] = std::ranges::minmax(values);
  const double middle = low == high ? low : mean(values);
  return list_of(values, [middle](double value) { return value - middle; });
}

}  // namespace

Moments& Moments::operator+=(const Moments& more) {
  aa += more.aa;
  ab += more.ab;
  bb += more.bb;
  return *this;
}

double Moments::correlation() const { return vary() ? ab / std::sqrt(aa * bb) : kNaN; }

Moments moments(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> less_a = less_mean(a);
  const std::vector<double> less_b = less_mean(b);
  Moments sums;
  for (std::size_t i = 0; i < a.size(); ++i)
    sums += {less_a[i] * less_a[i], less_a[i] * less_b[i], less_b[i] * less_b[i]};
  return sums;
}

std::vector<double> errors_of(const HeightPairs& pairs) {
  std::vector<double> errors_m;
  errors_m.reserve(pairs.truths_m.size());
  for (std::size_t i = 0; i < pairs.truths_m.size(); ++i)
    errors_m.push_back(pairs.estimates_m[i] - pairs.truths_m[i]);
  return errors_m;
}

}  // namespace plotscan::score
