// SPDX-License-Identifier: Apache-2.0
#include "core/statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

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

TEST(Selected, IsTheValueAtThePlaceOfTheSorted) {
  const std::vector<float> sorted{-2, 0, 0, 1, 5, 7};
  for (std::size_t place = 0; place < sorted.size(); ++place) {
    std::vector<float> values{5, 0, 7, -2, 1, 0};
    EXPECT_EQ(selected<float>(values, place), sorted[place]) << place;
    EXPECT_TRUE(std::ranges::is_permutation(values, sorted));
    values = {5, 0, 7, -2, 1, 0};
    EXPECT_EQ(selected_low<float>(values, place), sorted[place]) << place;
    EXPECT_TRUE(std::ranges::is_permutation(values, sorted));
  }
}

// Of squares with 1, 2, 3 and 10 points, the 8th and 9th of 16 lie in the one of 10.
TEST(SelfWeightedMedian, IsThatOfTheSquareOfTheMiddlePoint) {
  EXPECT_EQ(self_weighted_median<int>({3, 10, 1, 2}), 10);
  EXPECT_EQ(self_weighted_median<int>({3, 3, 1, 2}), 3);
  EXPECT_EQ(self_weighted_median<double>({0, 0, 2.5}), 2.5);
  EXPECT_EQ(self_weighted_median<int>({}), 0);
}

TEST(Mean, OfNothingIsNotANumber) {
  EXPECT_DOUBLE_EQ(mean({1, 2, 6}), 3);
  EXPECT_TRUE(std::isnan(mean({})));
}

}  // namespace
}  // namespace plotscan
