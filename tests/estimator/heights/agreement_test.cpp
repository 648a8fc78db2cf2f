// SPDX-License-Identifier: Apache-2.0
#include "heights/agreement.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::heights {
namespace {

Height sure_to(double value_m, double standard_error_m) {
  return {value_m, standard_error_m, value_m - 2 * standard_error_m,
          value_m + 2 * standard_error_m};
}

// Plots of 0.5 to 0.9 m whose measured heights are so many times the estimated ones.
std::vector<MeasuredPair> pairs_of(double factor, double standard_error_m, int count = 5) {
  std::vector<MeasuredPair> pairs;
  for (int i = 0; i < count; ++i) {
    const double height_m = 0.5 + 0.1 * (i % 5);
    pairs.push_back({sure_to(height_m, standard_error_m), factor * height_m});
  }
  return pairs;
}

TEST(Agreement, FollowsTheTableWhereEstimatesAreUnsureAndItIsConsistent) {
  const Agreement found = agreement(pairs_of(0.9, 0.07));
  EXPECT_NEAR(found.factor, 0.9, 0.01);
  EXPECT_GT(found.factor, 0.9);  // drawn towards 1
  EXPECT_EQ(found.plots, 5U);
}

// Five plots of height 1 m with standard errors of 0.1 m, measured as 0.8: by hand, the residual
// variance is 4 x 0.05^2 / 8, the data's 1/5 of it, and the prior's 0.1^2.
TEST(Agreement, IsThePosteriorOfTheNormalModel) {
  std::vector<MeasuredPair> pairs(5, {sure_to(1, 0.1), 0.8});
  const Agreement found = agreement(pairs);
  const double residual_m2 = 4 * 0.05 * 0.05 / 8;
  const double weight = 0.01 / (0.01 + residual_m2 / 5);
  EXPECT_NEAR(found.residual_m, std::sqrt(residual_m2), 1e-12);
  EXPECT_NEAR(found.factor, 1 - 0.2 * weight, 1e-12);
  EXPECT_NEAR(found.factor_sd, std::sqrt(weight * residual_m2 / 5), 1e-12);
  EXPECT_NEAR(found.t95, 2.306, 5e-4);  // of Student's t with 8 degrees of freedom, from tables
  const Height height = agreed(found, sure_to(0.5, 0.1));
  EXPECT_NEAR(height.value_m, 0.5 * found.factor, 1e-12);
  EXPECT_NEAR(height.high95_m - height.value_m, found.t95 * height.standard_error_m, 1e-12);
  EXPECT_NEAR(height.standard_error_m, std::hypot(found.residual_m, 0.5 * found.factor_sd), 1e-12);
}

TEST(Agreement, OfAnUnsteadyRulerStaysNearTheEstimates) {
  std::vector<MeasuredPair> pairs = pairs_of(1, 0.02);
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].measured_m += i % 2 == 0 ? 0.2 : -0.2;
  const Agreement found = agreement(pairs);
  EXPECT_NEAR(found.factor, 1, 0.02);
  EXPECT_GT(agreed(found, pairs[0].estimated).high95_m, pairs[0].estimated.high95_m);
}

// Fields whose error is a factor and a scatter as the prior has them: unmeasured plots lie in their
// intervals in 95 % of all cases, and nearer than before.
TEST(Agreement, HoldsWhatItStates) {
  int inside = 0;
  double before_m2 = 0;
  double after_m2 = 0;
  constexpr int kFields = 2000;
  for (std::uint64_t field = 0; field < kFields; ++field) {
    RandomStream random(7, random_purpose("test/agreement"), field);
    const double factor = 1 + 0.05 * random.normal();
    std::vector<MeasuredPair> pairs;
    for (int i = 0; i < 7; ++i) {
      const double estimated_m = random.uniform(0.6, 1);
      pairs.push_back({sure_to(estimated_m, 0.04), factor * estimated_m + 0.02 * random.normal()});
    }
    const MeasuredPair other = pairs.back();
    pairs.pop_back();
    const Height height = agreed(agreement(pairs), other.estimated);
    inside += other.measured_m > height.low95_m && other.measured_m < height.high95_m ? 1 : 0;
    before_m2 += std::pow(other.estimated.value_m - other.measured_m, 2);
    after_m2 += std::pow(height.value_m - other.measured_m, 2);
  }
  EXPECT_NEAR(inside, 0.95 * kFields, 0.015 * kFields);
  EXPECT_LT(after_m2, 0.4 * before_m2);
}

}  // namespace
}  // namespace plotscan::heights
