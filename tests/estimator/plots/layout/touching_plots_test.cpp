// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/internal/touching_plots.h"

#include <cmath>

#include "estimator/plots/known_trial.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plotscan::plots {
namespace {

constexpr double kCell_m = 0.05;

auto LieAt(const std::vector<double>& cells) {
  return ::testing::Pointwise(::testing::DoubleNear(1), cells);
}

// The profile along a field of 20 x 2 m.
template <class Canopy>
ProfileSums profile_of(const Canopy& canopy) {
  const CanopyRaster raster =
      raster_of(20, 2, [&](double a_m, double) { return canopy(a_m) ? 0.9 : 0.02; });
  const RowView view{.raster = &raster};
  const std::vector<Band> whole = {{0, view.c_cells()}};
  return ProfileSums(profile_along_r(view, whole));
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
}

}  // namespace
}  // namespace plotscan::plots
