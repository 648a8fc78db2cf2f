// SPDX-License-Identifier: Apache-2.0
#include "view/internal/ground_profile.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "viewer/shown_field.h"

namespace plotscan::view {
namespace {

const Eigen::Vector2d kCorner(552000, 4128000);
const Eigen::Vector2d kGradient(0.1, -0.2);

PlotBox tilted_box() {
  return {.center = kCorner + Eigen::Vector2d(6, 5),
          .width_m = 1.5,
          .length_m = 4,
          .heading_rad = std::numbers::pi / 6};
}

TEST(GroundProfile, FollowsThePlotsMiddle) {
  const ground::Surface surface = plane(kCorner, 300, kGradient, 60);
  const auto profile = ground_profile(surface, tilted_box(), 1);
  EXPECT_DOUBLE_EQ(profile.front().along_m, -1);
  EXPECT_DOUBLE_EQ(profile.back().along_m, 5);
  EXPECT_GE(profile.size(), 6 / 0.05);
  const Eigen::Vector2d axis(std::sqrt(3) / 2, 0.5);
  for (const ProfilePoint& point : profile) {
    const Eigen::Vector2d place = Eigen::Vector2d(6, 5) + (point.along_m - 2) * axis;
    EXPECT_NEAR(point.z_m, 300 + kGradient.dot(place), 1e-4);  // a float's step at 300 m
    EXPECT_NEAR(point.standard_error_m, 0.01, 1e-6);
    EXPECT_TRUE(point.seen);
  }
}

TEST(GroundProfile, TellsSeenFromInterpolatedAndOutOfReach) {
  ground::Surface surface = plane({0, 0}, 0, {0, 0}, 60);
  for (int row = 0; row < surface.rows; ++row) {
    for (int column = 0; column < surface.columns; ++column) {
      const auto node = static_cast<std::size_t>(row) * surface.columns + column;
      const double x = surface.cell_m * column;
      surface.seen[node] = x < 5.05;
      if (x > 6.9) surface.z_m[node] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  const PlotBox box{.center = {6, 6}, .width_m = 1, .length_m = 4, .heading_rad = 0};
  const auto profile = ground_profile(surface, box, 0);  // x from 4 to 8
  for (const ProfilePoint& point : profile) {
    const double x = 4 + point.along_m;
    // The last node with ground lies at 6.8, the middle between seen and not at 5.1.
    if (std::abs(x - 6.8) > 0.01) {
      EXPECT_EQ(std::isnan(point.z_m), x > 6.8) << x;
    }
    if (std::abs(x - 5.1) > 0.01) {
      EXPECT_EQ(point.seen, x < 5.1) << x;
    }
  }
  const auto whole = runs_of(profile, false);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_NEAR(whole[0].back().along_m, 2.8, 0.051);  // a step
  const auto parts = runs_of(profile, true);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_TRUE(parts[0].front().seen);
  EXPECT_FALSE(parts[1][1].seen);
  EXPECT_EQ(parts[0].back().along_m, parts[1].front().along_m) << "no gap between the parts";
  EXPECT_TRUE(
      runs_of(ground_profile(surface, {.center = {50, 50}, .length_m = 1}, 1), true).empty());
}

}  // namespace
}  // namespace plotscan::view
