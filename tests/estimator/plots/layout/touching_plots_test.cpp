// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/internal/touching_plots.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimator/plots/known_trial.h"

namespace plotscan::plots {
namespace {

constexpr double kCell_m = 0.05;

auto LieAt(const std::vector<double>& cells) {
  return ::testing::Pointwise(::testing::DoubleNear(1), cells);
}

// The profile along a field of 20 x 2 m; levels are 0 to 1.
template <class Level>
ProfileSums profile_of_levels(const Level& level) {
  const CanopyRaster raster = raster_of(20, 2, [&](double a_m, double) { return level(a_m); });
  const RowView view{.raster = &raster};
  const std::vector<Band> whole = {{0, view.c_cells()}};
  return ProfileSums(profile_along_r(view, whole));
}

template <class Canopy>
ProfileSums profile_of(const Canopy& canopy) {
  return profile_of_levels([&](double a_m) { return canopy(a_m) ? 0.9 : 0.02; });
}

std::optional<TouchingPlots> cut(const ProfileSums& profile, std::optional<double> side_m,
                                 std::optional<int> count = {}) {
  return touching_plots({&profile, 1}, kCell_m, side_m, count);
}

bool between(double a_m, double from_m, double to_m) { return a_m > from_m && a_m < to_m; }

// Three plots of 1.5 m, an alley, and four; their leaves hang 0.1 m over.
bool two_blocks(double a_m) { return between(a_m, 1.9, 6.6) || between(a_m, 7.9, 14.1); }

TEST(TouchingPlots, StandBetweenTheBordersAndTheAlleys) {
  const auto plots = cut(profile_of(two_blocks), 1.5);
  ASSERT_TRUE(plots);
  EXPECT_DOUBLE_EQ(plots->side, 30);
  EXPECT_THAT(plots->begins.front(), LieAt({40, 70, 100, 160, 190, 220, 250}));
}

// Rows 0.76 m apart run on from plot to plot; their leaves are 0.3 m wide.
TEST(TouchingPlots, HoldAsManyRowsEach) {
  const auto plots = cut(profile_of([](double a_m) {
                           return between(a_m, 2, 2 + 8 * 0.76) &&
                                  std::abs(std::remainder(a_m - 2.38, 0.76)) < 0.15;
                         }),
                         1.52);
  ASSERT_TRUE(plots);
  EXPECT_THAT(plots->begins.front(), LieAt({40, 70.4, 100.8, 131.2}));
}

// Two plots of two rows, an alley, and one: the leaves of each row reach 0.7 m to either side, so
// that all that stands there is longer by 0.7 m than what is sown.
TEST(TouchingPlots, EndHalfTheWayBetweenTwoRowsBeyondTheOuterOne) {
  constexpr double kSpacing_m = 0.65, kReach_m = 0.7;
  std::vector<double> rows_m;
  for (const double first_m : {2.0, 7.0})
    for (int row = 0; row < (first_m < 7 ? 4 : 2); ++row)
      rows_m.push_back(first_m + (row + 0.5) * kSpacing_m);
  const auto plots = cut(profile_of_levels([&](double a_m) {
                           double leaves = 0;
                           for (const double row_m : rows_m)
                             leaves += std::max(0.0, 1 - std::abs(a_m - row_m) / kReach_m);
                           return 0.5 * leaves;
                         }),
                         2 * kSpacing_m);
  ASSERT_TRUE(plots);
  EXPECT_THAT(plots->begins.front(), LieAt({40, 66, 140}));
}

// Plants of the outer rows lie down to either side, 0.5 m of 1.3 m: no row stands there.
TEST(TouchingPlots, AreNoMoreWhereOuterRowsLieDown) {
  const auto plots = cut(profile_of([](double a_m) {
                           return between(a_m, 1.5, 2 + 6 * 1.3 + 0.5) || between(a_m, 13, 14.3);
                         }),
                         1.3);
  ASSERT_TRUE(plots);
  EXPECT_THAT(plots->begins.front(), LieAt({40, 66, 92, 118, 144, 170, 260}));
}

// A strip of weeds is no plot, and one of 2 m is not one or two of 1.5 m and their leaves.
TEST(TouchingPlots, AreNotWhatStandsBesideThem) {
  const auto plots =
      cut(profile_of([](double a_m) {
            return between(a_m, 0.5, 0.8) || between(a_m, 2, 6.5) || between(a_m, 8, 10);
          }),
          1.5);
  ASSERT_TRUE(plots);
  EXPECT_THAT(plots->begins.front(), LieAt({40, 70, 100}));
}

TEST(TouchingPlots, ShareWhatStandsThereAsTheyWereCounted) {
  const ProfileSums profile = profile_of(two_blocks);
  const auto plots = cut(profile, {}, 7);
  ASSERT_TRUE(plots);
  EXPECT_NEAR(plots->side, 30, 2);  // with the leaves
  EXPECT_EQ(plots->begins.front().size(), 7U);
  EXPECT_TRUE(cut(profile, 1.5, 7));
  EXPECT_FALSE(cut(profile, 1.5, 8));
  EXPECT_FALSE(cut(profile, {}, 100'000)) << "plots of a tenth of a millimetre";
}

TEST(TouchingPlots, AreNoneWhereNothingIsKnownOrNothingStands) {
  EXPECT_FALSE(cut(profile_of(two_blocks), {}));
  EXPECT_FALSE(cut(profile_of([](double) { return false; }), 1.5));
  EXPECT_FALSE(cut(profile_of([](double) { return true; }), 2));
}

}  // namespace
}  // namespace plotscan::plots
