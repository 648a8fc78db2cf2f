// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/told_layout.h"

#include "estimator/plots/known_trial.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plotscan::plots {
namespace {

using ::testing::HasSubstr;

// Three rows of five plots.
TEST(ToldLayout, IsOneOfTheNumbersTold) {
  const TrialLayout trial = known_trial({0, 0, 0});
  for (const Hints& hints : {Hints{}, Hints{.rows = 3}, Hints{.columns = 5}, Hints{.plots = 15}})
    EXPECT_TRUE(is_as_told(trial, hints));
  for (const Hints& hints : {Hints{.rows = 4}, Hints{.columns = 4}, Hints{.plots = 14}})
    EXPECT_FALSE(is_as_told(trial, hints));
}

TEST(ToldLayout, IsRefusedWithOtherNumbers) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const FieldSigns signs{.least_gap_m = 0.4};
  EXPECT_EQ(not_told_because(trial, signs, {.rows = 3, .columns = 5}), "");
  EXPECT_THAT(not_told_because(trial, signs, {.rows = 4}),
              HasSubstr("shows 3 rows of plots, not the 4 told"));
  EXPECT_THAT(not_told_because(trial, signs, {.columns = 6}),
              HasSubstr("shows 5 columns of plots, not the 6 told"));
}

// More plots than there is room for overlap; plots of told sides may touch, and do so by a cell of
// the raster.
TEST(ToldLayout, IsRefusedWherePlotsOfANumberOverlap) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const FieldSigns overlapping{.least_gap_m = -0.1};
  EXPECT_THAT(not_told_because(trial, overlapping, {.plots = 15}), HasSubstr("would overlap"));
  EXPECT_EQ(not_told_because(trial, overlapping, {.width_m = 1.5, .plots = 15}), "");
  EXPECT_EQ(not_told_because(trial, {.least_gap_m = -0.04}, {.plots = 15}), "");
}

}  // namespace
}  // namespace plotscan::plots
