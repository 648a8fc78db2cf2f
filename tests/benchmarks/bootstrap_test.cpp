// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/bootstrap.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::farmbench {
namespace {

// Farms of independent normal errors of standard deviation 1.
std::vector<SquaredErrors> normal_farms(std::size_t farms, std::size_t plots, std::uint64_t seed) {
  std::vector<SquaredErrors> result(farms);
  for (std::size_t i = 0; i < farms; ++i) {
    RandomStream random(seed, random_purpose("test/bootstrap"), i);
    for (std::size_t plot = 0; plot < plots; ++plot) result[i].sum += std::pow(random.normal(), 2);
    result[i].count = plots;
  }
  return result;
}

TEST(BootstrapRmse, CoversTheTruthAndHasTheWidthOfTheClosedForm) {
  constexpr std::size_t kFarms = 40, kPlots = 30;
  constexpr int kTrials = 400;
  int covered = 0;
  double width = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Interval interval =
        bootstrap_rmse(normal_farms(kFarms, kPlots, static_cast<std::uint64_t>(trial)), 1);
    covered += interval.low <= 1 && 1 <= interval.high ? 1 : 0;
    width += (interval.high - interval.low) / kTrials;
  }
  // The mean of n squared standard normal numbers has variance 2 / n, its root nearly 1 / (2 n).
  const double closed_form = 2 * 1.96 / std::sqrt(2.0 * kFarms * kPlots);
  EXPECT_NEAR(width, closed_form, 0.05 * closed_form);
  // With 40 farms a percentile interval covers a little under 95 %; 400 trials tell 93 % to 1.3 %.
  EXPECT_GE(covered, static_cast<int>(0.90 * kTrials));
  EXPECT_LE(covered, static_cast<int>(0.975 * kTrials));
}

TEST(BootstrapRmse, DrawsWholeFarms) {
  // Two farms, each of one error throughout: a resample is both of one kind or one of each.
  const Interval interval =
      bootstrap_rmse({{.sum = 30 * 1.0, .count = 30}, {.sum = 30 * 9.0, .count = 30}}, 1);
  EXPECT_DOUBLE_EQ(interval.low, 1);
  EXPECT_DOUBLE_EQ(interval.high, 3);
}

TEST(BootstrapRmse, OneFarmHasNoInterval) {
  EXPECT_TRUE(std::isnan(bootstrap_rmse({{.sum = 3, .count = 3}}, 1).low));
  EXPECT_TRUE(std::isnan(bootstrap_rmse({{.sum = 3, .count = 3}, {}}, 1).high));
}

TEST(BootstrapRmse, TheSeedDecides) {
  const auto farms = normal_farms(10, 3, 5);
  EXPECT_EQ(bootstrap_rmse(farms, 1).low, bootstrap_rmse(farms, 1).low);
  EXPECT_NE(bootstrap_rmse(farms, 1).low, bootstrap_rmse(farms, 2).low);
}

// Every farm's squared errors quadruple: in each resample the RMSE doubles, however it is drawn.
TEST(BootstrapRmseChange, DrawsFarmsInPairs) {
  const auto before = normal_farms(20, 10, 3);
  auto after = before;
  for (SquaredErrors& farm : after) farm.sum *= 4;
  const Interval change = bootstrap_rmse_change(before, after, 1);
  const Interval rmse_before = bootstrap_rmse(before, 1);
  EXPECT_NEAR(change.low, rmse_before.low, 1e-12);
  EXPECT_NEAR(change.high, rmse_before.high, 1e-12);
  EXPECT_EQ(bootstrap_rmse_change(before, before, 1).high, 0);
  EXPECT_TRUE(std::isnan(bootstrap_rmse_change({{.sum = 3, .count = 3}, {}}, {{}, {}}, 1).low));
}

}  // namespace
}  // namespace plotscan::farmbench
