// SPDX-License-Identifier: Apache-2.0
#include "core/trial_layout.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/angle.h"

namespace plotscan {
namespace {

Eigen::Vector2d direction(double angle_deg) {
  return {std::cos(angle_deg * kDegrees), std::sin(angle_deg * kDegrees)};
}

// Plots whose length points 30 degrees from x, in rows that are 5 degrees off the perpendicular.
TrialLayout skewed() {
  return {.origin = {100, 200},
          .row_axis = direction(30 - 90 + 5),
          .column_axis = direction(30),
          .width_m = 1.5,
          .length_m = 4,
          .places = {{.row = 1, .column = 1, .position_m = {0, 0}},
                     {.row = 2, .column = 3, .position_m = {4, 6}}}};
}

TEST(TrialLayout, HasTheAnglesOfItsAxes) {
  EXPECT_NEAR(skewed().heading_rad(), 30 * kDegrees, 1e-12);
  EXPECT_NEAR(skewed().skew_rad(), 5 * kDegrees, 1e-12);
  EXPECT_NEAR(TrialLayout{}.skew_rad(), 0, 1e-12);
}

TEST(TrialLayout, CountsRowsAndColumns) {
  EXPECT_EQ(skewed().rows(), 2);
  EXPECT_EQ(skewed().columns(), 3);
  EXPECT_EQ(TrialLayout{}.rows(), 0);
}

// Four metres along the row and six along the length, by hand.
TEST(TrialLayout, PutsABoxAtAPlace) {
  const TrialLayout layout = skewed();
  const PlotBox box = layout.box(layout.places[1]);
  EXPECT_NEAR(box.center.x(), 100 + 4 * std::cos(-55 * kDegrees) + 6 * std::cos(30 * kDegrees),
              1e-9);
  EXPECT_NEAR(box.center.y(), 200 + 4 * std::sin(-55 * kDegrees) + 6 * std::sin(30 * kDegrees),
              1e-9);
  EXPECT_NEAR(box.heading_rad, 30 * kDegrees, 1e-12);
  EXPECT_EQ(box.width_m, 1.5);
  EXPECT_EQ(box.length_m, 4);
}

}  // namespace
}  // namespace plotscan
