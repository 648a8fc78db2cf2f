// SPDX-License-Identifier: Apache-2.0
#include "core/statistics.h"

#include <cmath>

#include <gtest/gtest.h>

namespace plotscan {
namespace {

TEST(Quantile, IsNumpysDefault) {
  // numpy.quantile([3, 1, 4, 1, 5], [0, .25, .5, .9, 1])
  const std::vector<double> values{3, 1, 4, 1, 5};
  EXPECT_DOUBLE_EQ(quantile(values, 0), 1);
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 1);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 3);
  EXPECT_DOUBLE_EQ(quantile(values, 0.9), 4.6);
  EXPECT_DOUBLE_EQ(quantile(values, 1), 5);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Mean, OfNothingIsNotANumber) {
  EXPECT_DOUBLE_EQ(mean({1, 2, 6}), 3);
  EXPECT_TRUE(std::isnan(mean({})));
}

}  // namespace
}  // namespace plotscan
