// SPDX-License-Identifier: Apache-2.0
#include "heights/agreement.h"

#include <cmath>
#include <vector>

#include <boost/math/distributions/students_t.hpp>

#include "core/error.h"
#include "core/statistics.h"

namespace plotscan::heights {
namespace {

// The prior of the residuals, chosen on 86 fields of every kind: their plots scatter by a third of
// the estimates' standard errors about the field's factor, or less, but where plants are few.
constexpr double kPriorDegrees = 4;
constexpr double kPriorResidual = 0.5;  // of the estimates' median standard error

struct Medians {
  double error_m;      // standard error of an estimate
  double error_share;  // and of that the share of the estimate
};

Medians medians_of(std::span<const MeasuredPair> pairs) {
  std::vector<double> errors_m, shares;
  for (const MeasuredPair& pair : pairs) {
    errors_m.push_back(pair.estimated.standard_error_m);
    shares.push_back(pair.estimated.standard_error_m / pair.estimated.value_m);
  }
  return {quantile(errors_m, 0.5), quantile(shares, 0.5)};
}

}  // namespace

Agreement agreement(std::span<const MeasuredPair> pairs) {
  check(pairs.size() >= kLeastMeasured, "too few measured plots");
  double squares_m2 = 0;
  double products_m2 = 0;
  for (const auto& [estimated, measured_m] : pairs) {
    squares_m2 += estimated.value_m * estimated.value_m;
    products_m2 += estimated.value_m * measured_m;
  }
  const double least_squares = products_m2 / squares_m2;
  const Medians prior = medians_of(pairs);
  const double prior_m = kPriorResidual * prior.error_m;
  double residuals_m2 = kPriorDegrees * prior_m * prior_m;
  for (const auto& [estimated, measured_m] : pairs)
    residuals_m2 += std::pow(measured_m - least_squares * estimated.value_m, 2);
  const double degrees = kPriorDegrees + static_cast<double>(pairs.size()) - 1;
  const double residual_m2 = residuals_m2 / degrees;
  const double data_variance = residual_m2 / squares_m2;
  const double prior_variance = prior.error_share * prior.error_share;
  const double weight = prior_variance / (prior_variance + data_variance);
  const boost::math::students_t student(degrees);
  return {.plots = pairs.size(),
          .factor = 1 + weight * (least_squares - 1),
          .factor_sd = std::sqrt(weight * data_variance),
          .residual_m = std::sqrt(residual_m2),
          .t95 = boost::math::quantile(student, 0.975)};
}

Height agreed(const Agreement& agreement, const Height& estimated) {
  const double value_m = agreement.factor * estimated.value_m;
  const double error_m = std::hypot(agreement.residual_m, agreement.factor_sd * estimated.value_m);
  return {.value_m = value_m,
          .standard_error_m = error_m,
          .low95_m = value_m - agreement.t95 * error_m,
          .high95_m = value_m + agreement.t95 * error_m};
}

}  // namespace plotscan::heights
