// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/scan_edge.h"

#include <cmath>

#include <gtest/gtest.h>

#include "estimator/plots/known_trial.h"
#include "estimator/plots/trial_cloud.h"

namespace plotscan::plots {
namespace {

// The ground ends 5 cm beyond the last column's sides: there, and nowhere else, plots are cut off.
TEST(IsCutOff, ArePlotsAtTheEdgeOfTheScan) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const double end_m = trial.box(trial.places.back()).center.y() + 0.8;
  for (const TrialPlace& place : trial.places)
    EXPECT_EQ(is_cut_off(trial.box(place), [&](const auto& at) { return at.y() < end_m; }),
              place.column == 5)
        << place.row << ' ' << place.column;
}

// Two metres farther the scan still goes on.
TEST(IsCutOff, IsNoPlotWellWithinTheScan) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const double end_m = trial.box(trial.places.back()).center.y() + 0.75 + 2;
  for (const TrialPlace& place : trial.places)
    EXPECT_FALSE(is_cut_off(trial.box(place), [&](const auto& at) { return at.y() < end_m; }));
}

// Water all around each plot gives no returns, but the scan goes on behind it.
TEST(IsCutOff, IsNoPlotBesideAGapInTheScan) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const auto is_water = [&](const Eigen::Vector2d& at) {
    bool water = false;
    for (const TrialPlace& place : trial.places) {
      PlotBox around = trial.box(place);
      if (around.contains(at)) return false;
      around.width_m += 0.8;
      around.length_m += 1;
      water = water || around.contains(at);
    }
    return water;
  };
  for (const TrialPlace& place : trial.places)
    EXPECT_FALSE(is_cut_off(trial.box(place), [&](const auto& at) { return !is_water(at); }));
}

// A cloud that ends 5 cm beyond the outer columns' sides, at y = 5.5 m on either side.
TEST(IsCutOff, IsSaidOfThePlotsFound) {
  const PlotField field =
      find_plots(cloud_over(Trial{.heading_rad = 0}.boxes(), everywhere, 12, 5.55), 0.02, {}, 2);
  ASSERT_EQ(field.plots.size(), 18u);
  for (const FoundPlot& plot : field.plots)
    EXPECT_EQ(plot.cut_off, std::abs(plot.box.center.y()) > 4) << plot.box.center.transpose();
}

}  // namespace
}  // namespace plotscan::plots
