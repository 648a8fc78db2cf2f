// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/heading.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/plot_box.h"
#include "estimator/plots/known_trial.h"

namespace plotscan::plots {
namespace {

// Plots of 4 x 1.5 m at steps of 5 x 2 m on the middle 16 m of 24 x 24 m. The lines between the
// rows run at heading_rad; those between the columns `skew_rad` off the right angle.
CanopyRaster turned_field(double heading_rad, double skew_rad = 0, double canopy = 0.8) {
  const double second_rad = heading_rad + std::numbers::pi / 2 + skew_rad;
  return raster_of(
      24, 24,
      [&](double x, double y) {
        const Eigen::Vector2d at(x - 12, y - 12);
        if (at.norm() > 9) return canopy / 40;
        // Across either family of lines.
        const double u = std::cos(second_rad) * at.y() - std::sin(second_rad) * at.x();
        const double v = std::cos(heading_rad) * at.y() - std::sin(heading_rad) * at.x();
        return std::abs(std::remainder(u, 5)) < 2 && std::abs(std::remainder(v, 2)) < 0.75
                   ? canopy
                   : canopy / 40;
      },
      0.1);
}

// The nearest way from a direction to a line of the other.
double off_rad(double a_rad, double b_rad) {
  return std::abs(std::remainder(a_rad - b_rad, std::numbers::pi));
}

TEST(FindAxes, TurnWithTheField) {
  for (const double heading_deg : {0.0, 12.34, 33.0, 45.0, 71.9}) {
    const double truth = heading_deg * kDegrees;
    const auto axes = find_axes(turned_field(truth), std::nullopt, 2);
    ASSERT_EQ(axes.size(), 1U);
    // Either family may be the first.
    EXPECT_LT(std::abs(std::remainder(axes[0].first_rad - truth, std::numbers::pi / 2)),
              0.15 * kDegrees)
        << heading_deg;
    EXPECT_NEAR(axes[0].second_rad - axes[0].first_rad, std::numbers::pi / 2, 1e-9);
  }
}

TEST(FindAxes, TurnWithSeedlings) {
  const auto axes = find_axes(turned_field(20 * kDegrees, 0, 0.08), std::nullopt, 2);
  ASSERT_EQ(axes.size(), 1U);
  EXPECT_LT(std::abs(std::remainder(axes[0].first_rad - 20 * kDegrees, kPi / 2)), 0.2 * kDegrees);
}

TEST(FindAxes, MayBeSkewed) {
  const auto axes = find_axes(turned_field(20 * kDegrees, 8 * kDegrees), 20 * kDegrees, 2);
  ASSERT_EQ(axes.size(), 1U);
  EXPECT_LT(off_rad(axes[0].first_rad, 20 * kDegrees), 0.2 * kDegrees);
  EXPECT_LT(off_rad(axes[0].second_rad, 118 * kDegrees), 0.2 * kDegrees);
}

TEST(FindAxes, BeginWithTheOneNearTheHint) {
  for (const double hint_deg : {31.0, 122.0}) {
    const auto axes = find_axes(turned_field(33 * kDegrees), hint_deg * kDegrees, 2);
    EXPECT_LT(off_rad(axes.front().first_rad, hint_deg * kDegrees), 3 * kDegrees);
  }
}

// A dense windrow 20 m long, 25 degrees off thin plots.
TEST(FindAxes, AreThosePlotsToo) {
  const double heading_rad = 40 * kDegrees;
  const CanopyRaster plots = turned_field(heading_rad);
  const CanopyRaster raster = raster_of(
      24, 24,
      [&](double x, double y) {
        const int a = static_cast<int>(x / 0.1), b = static_cast<int>(y / 0.1);
        const double across =
            std::cos(15 * kDegrees) * (y - 22) - std::sin(15 * kDegrees) * (x - 12);
        return std::abs(across) < 0.8 ? 1 : 0.2 * plots.cover(a, a + 1, b, b + 1);
      },
      0.1);
  const auto axes = find_axes(raster, std::nullopt, 2);
  ASSERT_GE(axes.size(), 2U);
  const auto off = [](const FieldAxes& of, double rad) {
    return std::abs(std::remainder(of.first_rad - rad, std::numbers::pi / 2));
  };
  EXPECT_LT(off(axes.front(), 15 * kDegrees), 0.5 * kDegrees);
  EXPECT_LT(off(axes.back(), heading_rad), 0.5 * kDegrees);
  for (const FieldAxes& told : find_axes(raster, 15 * kDegrees, 2))
    EXPECT_LT(off(told, 15 * kDegrees), 5 * kDegrees);
}

TEST(FindAxes, AreNoneWithoutCanopy) {
  EXPECT_TRUE(find_axes(raster_of(5, 5, [](double, double) { return 0.0; }), {}, 2).empty());
}

}  // namespace
}  // namespace plotscan::plots
