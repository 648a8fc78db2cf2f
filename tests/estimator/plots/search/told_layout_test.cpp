// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/told_layout.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimator/plots/known_trial.h"
#include "estimator/plots/trial_cloud.h"

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

// Plots of 1.5 x 3 m that follow each other by 1.9 and 3.8 m.
TEST(ToldLayout, IsOneOfTheSidesOrOfTheStepsTold) {
  const TrialLayout trial = known_trial({0, 0, 0});
  for (const Hints& hints : {Hints{.width_m = 1.3, .length_m = 3.1}, Hints{.width_m = 1.9},
                             Hints{.width_m = 1.9, .length_m = 3.8}})
    EXPECT_TRUE(is_as_told(trial, hints)) << hints.width_m.value();
  for (const Hints& hints : {Hints{.width_m = 1.1}, Hints{.width_m = 2}, Hints{.length_m = 4.5}})
    EXPECT_FALSE(is_as_told(trial, hints));
}

// The second row begins half a step farther on: its columns are 2 to 6.
TEST(ToldLayout, HasTheColumnsOfItsWidestRow) {
  TrialLayout trial = known_trial({0, 0.95, 0});
  for (TrialPlace& place : trial.places) place.column += place.row == 2 ? 1 : 0;
  EXPECT_TRUE(is_as_told(trial, {.rows = 3, .columns = 5}));
  EXPECT_EQ(not_told_because(trial, {.least_gap_m = 0.4}, {.columns = 5}), "");
  EXPECT_FALSE(is_as_told(trial, {.columns = 6}));
}

TEST(ToldLayout, GivesFoundPlotsTheSidesTold) {
  PlotField field{.plots = {{.box = {.center = {3, 2}, .width_m = 1.4, .length_m = 3.1}}}};
  field.plots[0].box_error = {.along_m = 0.1, .width_m = 0.1, .length_m = 0.1};
  field.fit.emplace().layout = known_trial({0});
  const PlotField told = with_sides(field, {.width_m = 1.9});
  EXPECT_EQ(told.fit->layout.width_m, 1.9);
  EXPECT_EQ(told.plots[0].box.width_m, 1.9);
  EXPECT_EQ(told.plots[0].box.length_m, 3);
  EXPECT_EQ(told.plots[0].box_error.width_m, 0);
  EXPECT_EQ(told.plots[0].box_error.length_m, 0.1);
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

// Plots of `rows` drill rows that run on at one spacing from plot to plot, leaves to either side of
// them: between plots there is no more to see than between their rows.
void expect_drilled(double width_m, int rows, double leaves_m) {
  const Trial trial{.rows = 4, .gap_m = 0, .offsets_m = {0, 0, 0, 0}, .width_m = width_m};
  const double spacing_m = width_m / rows;
  const auto sown = [&](const PlotBox&, const Eigen::Vector2d& at) {
    const double from_row_m = std::remainder(at.y() - 0.5 * (rows - 1) * spacing_m, spacing_m);
    return std::abs(from_row_m) < leaves_m;
  };
  const std::vector<PlotBox> boxes = trial.boxes();
  const auto points = cloud_over(boxes, sown, 14, 14);
  expect_those(boxes, find_plots(points, 0.02, {.width_m = width_m, .length_m = 4}, 2), 0.85);
}

// With both sides 16 were found, and 24 with the length alone.
TEST(ToldPlots, OfTwoRowsAreFoundWithOneSideToo) { expect_drilled(0.77, 2, 0.17); }

// A pattern of half as many plots, one row between them, has as much canopy in its gaps as in its
// plots.
TEST(ToldPlots, OfThreeRowsAreNotEveryOtherGroupOfRows) { expect_drilled(1.5, 3, 0.14); }

}  // namespace
}  // namespace plotscan::plots
