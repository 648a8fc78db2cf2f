// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/statistics.h"
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

// The least residual squares of two levels, inside an outline and outside, over outlines of all
// sizes, cell by cell.
template <class Inside>
double least_squares_left(const RowView& view, const CellBox& box, const Inside& inside) {
  double least = std::numeric_limits<double>::infinity();
  const int rows = box.r1 - box.r0, columns = box.c1 - box.c0;
  for (int step = 0; step < 17 * 17; ++step) {
    std::vector<double> levels[2];
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        const double y = ((r + 0.5) / rows - 0.5) * 2 / (0.6 + 0.05 * (step / 17));
        const double x = ((c + 0.5) / columns - 0.5) * 2 / (0.6 + 0.05 * (step % 17));
        levels[inside(x, y) ? 1 : 0].push_back(
            view.cover(box.r0 + r, box.r0 + r + 1, box.c0 + c, box.c0 + c + 1));
      }
    }
    double left = 0;
    for (const std::vector<double>& values : levels) {
      const double level = mean(values);
      for (const double value : values) left += (value - level) * (value - level);
    }
    least = std::min(least, left);
  }
  return least;
}

// One plot, uneven and fuller on one side.
TEST(Squareness, OfAnOutlineIsThatOfTheBestOfAllOutlines) {
  const TrialLayout trial = known_trial({0}, 1);
  const CanopyRaster raster = canopy_in_plots(trial, [&](const Eigen::Vector2d& off) {
    const double x = off.x() / trial.length_m, y = off.y() / trial.width_m;
    const double edge = 0.47 + 0.05 * std::sin(30 * x + 20 * y);
    return std::abs(x) < edge && std::abs(y) < 0.9 * edge ? 0.9 + 0.4 * x : 0.05;
  });
  Lattice lattice = lattice_of(trial, raster);
  lattice.r.pitch_m = lattice.c.pitch_m = 0;  // no plot beside it: 0.4 m around it count
  CellBox box = cells_about(lattice, lattice.places.front(), 0.4);
  box.r1 = box.r0 + static_cast<int>((lattice.r.size_m + 0.8) / raster.cell_m());
  box.c1 = box.c0 + static_cast<int>((lattice.c.size_m + 0.8) / raster.cell_m());
  const double ellipse =
      least_squares_left(lattice.view, box, [](double x, double y) { return x * x + y * y < 1; });
  const double rectangle = least_squares_left(
      lattice.view, box, [](double x, double y) { return std::abs(x) < 1 && std::abs(y) < 1; });
  EXPECT_NEAR(squareness_of(lattice).of_outline, ellipse / rectangle, 1e-9);
}

}  // namespace
}  // namespace plotscan::plots
