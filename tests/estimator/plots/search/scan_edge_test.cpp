// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/scan_edge.h"

#include <algorithm>

#include "estimator/plots/known_trial.h"
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace plotscan::plots
