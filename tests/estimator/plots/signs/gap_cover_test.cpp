// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "estimator/plots/known_trial.h"
#include "plots/signs/internal/plot_shape.h"

namespace plotscan::plots {
namespace {

constexpr double kPlotCover = 0.8;

// Cover beside plots of cover kPlotCover, at (x, y).
using Beside = std::function<double(double x, double y)>;

double gap_cover_with(const TrialLayout& trial, const Beside& beside) {
  const CanopyRaster raster = raster_of(20, 14, [&](double x, double y) {
    const bool in_plot = std::ranges::any_of(trial.places, [&](const TrialPlace& place) {
      return trial.box(place).contains({x, y});
    });
    return in_plot ? kPlotCover : beside(x, y);
  });
  return gap_cover(lattice_of(trial, raster));
}

TEST(GapCover, IsThatOfTheGapsOverThatOfThePlots) {
  const auto even = [](double, double) { return 0.2; };
  EXPECT_NEAR(gap_cover_with(known_trial({0, 0}), even), 0.2 / kPlotCover, 1e-6);
}

// Rows that run on, cut into pieces, have wide gaps along the other axis.
TEST(GapCover, IsThatOfTheAxisAlongWhichGapsAreFuller) {
  const auto along = [](double x, double) { return x > 1.5 && x < 4.5 ? 0.76 : 0; };
  const auto across = [](double x, double) { return x > 4.5 && x < 5.3 ? 0.76 : 0; };
  EXPECT_NEAR(gap_cover_with(known_trial({0}), along), 0.76 / kPlotCover, 1e-6);
  EXPECT_NEAR(gap_cover_with(known_trial({0, 0}), across), 0.76 / kPlotCover, 1e-6);
}

// Two of four gaps are closed: they have half of the plots' cover p, and differ from it by p / 2.
TEST(GapCover, AllowsForThreeStandardErrors) {
  const auto two_closed = [](double, double y) { return y < 5.8 ? kPlotCover : 0; };
  const double error = std::sqrt(4 * 0.25 / 3 / 4);
  EXPECT_NEAR(gap_cover_with(known_trial({0}), two_closed), 0.5 + 3 * error, 1e-6);
}

// Beside a plot of the other row lies a gap, not the next plot.
TEST(GapCover, IsMeasuredWherePlotsAreOppositeEachOther) {
  EXPECT_NEAR(gap_cover_with(known_trial({0, 0.95}), [](double, double) { return 0.2; }),
              0.2 / kPlotCover, 1e-6);
}

TEST(GapCover, IsThatOfThePlotsWhereTheyOverlap) {
  TrialLayout trial = known_trial({0});
  trial.width_m = 2;  // at steps of 1.9 m
  EXPECT_NEAR(gap_cover_with(trial, [](double, double) { return 0; }), 1, 1e-6);
}

TEST(GapCover, IsNoneOfASinglePlot) {
  EXPECT_EQ(gap_cover_with(known_trial({0}, 1), [](double, double) { return 0.8; }), 0);
}

}  // namespace
}  // namespace plotscan::plots
