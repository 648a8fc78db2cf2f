// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "estimator/plots/known_trial.h"
#include "plots/signs/internal/plot_shape.h"

namespace plotscan::plots {
namespace {

// Of an optical depth in every plot that depends on the place in it, x and y in its half sides.
template <class Depth>
Squareness squareness_with(const Depth& depth) {
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_in_plots(trial, [&](const Eigen::Vector2d& off) {
    return depth(2 * off.x() / trial.length_m, 2 * off.y() / trial.width_m);
  });
  return squareness_of(lattice_of(trial, raster));
}

TEST(Squareness, IsHighWhereSidesAreStraight) {
  const auto [of_outline, of_canopy] = squareness_with(
      [](double x, double y) { return std::abs(x) < 1 && std::abs(y) < 1 ? 0.8 : 0; });
  EXPECT_GT(of_outline, 2);
  EXPECT_GT(of_canopy, 3);
}

TEST(Squareness, IsLowOfCrowns) {
  const auto [of_outline, of_canopy] =
      squareness_with([](double x, double y) { return std::hypot(x, y) < 1 ? 0.8 : 0; });
  EXPECT_LT(of_outline, 0.5);
  EXPECT_LT(of_canopy, 0.5);
}

// A parabola with its top in the middle, wider than the plots along y.
TEST(Squareness, IsLowOfMounds) {
  const auto [of_outline, of_canopy] = squareness_with(
      [](double x, double y) { return 0.8 * std::max(0.0, 1 - x * x - 0.7 * y * y); });
  EXPECT_LT(of_outline, 1);
  EXPECT_LT(of_canopy, 0.8);
}

// A bell is a function of the distance, and a product of two as well.
TEST(Squareness, IsLowOfConifers) {
  const auto [of_outline, of_canopy] =
      squareness_with([](double x, double y) { return 0.8 * std::exp(-2 * (x * x + y * y)); });
  EXPECT_LT(of_outline, 0.9);
  EXPECT_LT(of_canopy, 2);
}

// Two rows whose leaves are thickest over the middle and hang over the sides: two levels in an
// ellipse are as good as in a rectangle, but the ends are straight.
TEST(Squareness, IsHighOfRowsWhoseLeavesHangOverTheSides) {
  const auto [of_outline, of_canopy] = squareness_with([](double x, double y) {
    const auto row = [](double off) { return 0.5 * std::exp(-0.5 * off * off / 0.08); };
    return std::abs(x) < 1 ? row(y - 0.3) + row(y + 0.3) : 0;
  });
  EXPECT_LT(of_outline, 1.5);
  EXPECT_GT(of_canopy, 3);
}

}  // namespace
}  // namespace plotscan::plots
