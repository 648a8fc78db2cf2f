// SPDX-License-Identifier: Apache-2.0
#include "score/within_farms.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::score {
namespace {

HeightPairs pairs(const std::vector<double>& estimates_m, const std::vector<double>& truths_m) {
  return {.estimates_m = estimates_m, .truths_m = truths_m};
}

// Estimates are the truth, compressed, noisy, and off by the farm's own bias.
std::vector<HeightPairs> random_farms() {
  std::vector<HeightPairs> farms;
  for (std::uint64_t farm = 0; farm < 6; ++farm) {
    RandomStream random(4, random_purpose("test/farms"), farm);
    const double bias_m = 0.05 * random.normal();
    HeightPairs pairs;
    for (std::uint64_t plot = 0; plot < 10 + farm; ++plot) {
      pairs.truths_m.push_back(random.uniform(0.6, 0.8));
      pairs.estimates_m.push_back(0.2 + 0.7 * pairs.truths_m.back() + bias_m +
                                  0.02 * random.normal());
    }
    farms.push_back(pairs);
  }
  return farms;
}

// Errors +2 and +4 cm on one farm, -1 and -1 on the other: biases +3 and -1, rests 1, 1, 0, 0.
TEST(ScoreWithin, ByHand) {
  const WithinFarms score = score_within(
      std::vector{pairs({1.02, 1.24}, {1.0, 1.2}), pairs({0.49, 0.79}, {0.5, 0.8}), HeightPairs{}});
  EXPECT_EQ(score.farms, 2U);
  EXPECT_NEAR(score.farm_bias_m, std::sqrt((9e-4 + 1e-4) / 2), 1e-12);
  EXPECT_NEAR(score.worst_bias_m, 0.03, 1e-12);
  EXPECT_NEAR(score.within_m, std::sqrt(2e-4 / 4), 1e-12);
  // Less their means: truths +-0.1 and +-0.15, estimates +-0.11 and +-0.15.
  const double aa = 2 * (0.11 * 0.11 + 0.15 * 0.15), bb = 2 * (0.1 * 0.1 + 0.15 * 0.15);
  const double ab = 2 * (0.11 * 0.1 + 0.15 * 0.15);
  EXPECT_NEAR(score.r2, ab * ab / (aa * bb), 1e-12);
  EXPECT_NEAR(score.rho, 1, 1e-12);
}

// Every farm has 10 plots and more: the squared error is the bias' and the rest's together.
TEST(ScoreWithin, TakesTheErrorApart) {
  const std::vector<HeightPairs> farms = random_farms();
  double squared = 0, rest = 0, plots = 0;
  for (const HeightPairs& farm : farms) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < farm.truths_m.size(); ++i)
      errors.push_back(farm.estimates_m[i] - farm.truths_m[i]);
    const double bias =
        std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
    for (const double error : errors) {
      squared += error * error - bias * bias;
      rest += (error - bias) * (error - bias);
      ++plots;
    }
  }
  const WithinFarms score = score_within(farms);
  EXPECT_NEAR(score.within_m, std::sqrt(squared / plots), 1e-12);
  EXPECT_NEAR(score.within_m, std::sqrt(rest / plots), 1e-12);
}

// A farm's own bias and one scale for all change neither r2 nor rho; a constant estimate has none.
TEST(ScoreWithin, TheOrderOfPlotsIsBlindToBiasAndScale) {
  std::vector<HeightPairs> farms = random_farms();
  const WithinFarms before = score_within(farms);
  EXPECT_GT(before.r2, 0.5);
  double bias_m = 1;
  for (HeightPairs& farm : farms) {
    for (double& estimate : farm.estimates_m) estimate = 3 * estimate + bias_m;
    bias_m += 1;
  }
  const WithinFarms after = score_within(farms);
  EXPECT_NEAR(after.r2, before.r2, 1e-9);
  EXPECT_NEAR(after.rho, before.rho, 1e-12);
  for (HeightPairs& farm : farms)
    for (double& estimate : farm.estimates_m) estimate = 0.1 + 0.2;
  const WithinFarms constant = score_within(farms);
  EXPECT_TRUE(std::isnan(constant.r2) && std::isnan(constant.rho));
  EXPECT_GT(constant.within_m, 0.05);  // the truths' own spread, uniform over 0.2 m
  EXPECT_LT(constant.within_m, 0.065);
}

// Without ties Spearman's rho is 1 - 6 sum d^2 / (n (n^2 - 1)), d by counting smaller values.
TEST(ScoreWithin, RhoIsSpearmans) {
  double expected = 0, plots = 0;
  for (const HeightPairs& farm : random_farms()) {
    const std::size_t count = farm.truths_m.size();
    double squared = 0;
    for (std::size_t i = 0; i < count; ++i) {
      int rank = 0;
      for (std::size_t j = 0; j < count; ++j)
        rank += (farm.truths_m[j] < farm.truths_m[i]) - (farm.estimates_m[j] < farm.estimates_m[i]);
      squared += rank * rank;
    }
    const auto n = static_cast<double>(count);
    expected += n * (1 - 6 * squared / (n * (n * n - 1)));
    plots += n;
  }
  EXPECT_NEAR(score_within(random_farms()).rho, expected / plots, 1e-12);
}

TEST(ScoreWithin, EqualValuesShareTheirRank) {
  // Ranks 1.5 1.5 3 and 1 2 3: rho = 1.5 / sqrt(1.5 * 2).
  const WithinFarms score = score_within(std::vector{pairs({0.5, 0.5, 0.9}, {0.1, 0.2, 0.3})});
  EXPECT_NEAR(score.rho, 1.5 / std::sqrt(3.0), 1e-12);
}

TEST(ScoreWithin, NothingFoundHasNoScore) {
  const WithinFarms score = score_within(std::vector{HeightPairs{}});
  EXPECT_EQ(score.farms, 0U);
  EXPECT_TRUE(std::isnan(score.farm_bias_m) && std::isnan(score.worst_bias_m) &&
              std::isnan(score.within_m) && std::isnan(score.r2) && std::isnan(score.rho));
}

}  // namespace
}  // namespace plotscan::score
