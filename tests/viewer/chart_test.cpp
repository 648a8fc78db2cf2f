// SPDX-License-Identifier: Apache-2.0
// Marks, labels and colours of charts, without a picture.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "view/internal/box_labels.h"
#include "view/internal/height_colours.h"
#include "view/internal/scale.h"

namespace plotscan::view {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

TEST(Ticks, AreMultiplesOfARoundStep) {
  const Ticks ticks = ticks_between(-0.31, 0.52, 0.13);
  EXPECT_DOUBLE_EQ(ticks.step, 0.2);
  EXPECT_THAT(ticks.values, ElementsAre(DoubleNear(-0.2, 1e-12), DoubleNear(0, 1e-12),
                                        DoubleNear(0.2, 1e-12), DoubleNear(0.4, 1e-12)));
  EXPECT_EQ(ticks.text(ticks.values[1]), "0.0");
  EXPECT_EQ(ticks.text(-1e-17), "0.0");
  const Ticks far = ticks_between(552001, 552012, 4);
  EXPECT_THAT(far.values, ElementsAre(552005, 552010));
  EXPECT_EQ(far.text(552010, 552000), "10");
}

TEST(Ticks, IncludeTheEnds) {
  EXPECT_THAT(ticks_between(0, 0.3, 0.1).values.size(), 4);
  EXPECT_THAT(ticks_between(10, 20, 7).values, ElementsAre(10, 20));
}

// Luma of ITU-R BT.601: what a reader without colours sees.
double luma(const Rgb& c) { return 0.299 * c.red + 0.587 * c.green + 0.114 * c.blue; }

TEST(HeightColours, DarkenWithHeight) {
  const HeightColours colours{.top_m = 2};
  double before = 256;
  for (double height_m = 0; height_m <= 2; height_m += 0.1) {
    EXPECT_LT(luma(colours.of(height_m)), before);
    before = luma(colours.of(height_m));
  }
  EXPECT_EQ(luma(colours.of(-1)), luma(colours.of(0)));
  EXPECT_EQ(luma(colours.of(9)), luma(colours.of(2)));
}

// Plots in a row, `side_px` wide, three times as long.
std::vector<BoxLabel> row_of_boxes(int count, double side_px, double heading_rad) {
  std::vector<BoxLabel> labels;
  for (int i = 0; i < count; ++i) {
    PlotBox box{.width_m = side_px, .length_m = 3 * side_px, .heading_rad = heading_rad};
    box.center = 1.2 * side_px * i * box.width_axis();
    labels.push_back({std::to_string(100 + i), box, i == 7});
  }
  return labels;
}

void expect_inside(const std::vector<BoxLabel>& labels, const std::vector<PlacedLabel>& placed) {
  for (const PlacedLabel& label : placed) {
    for (const Eigen::Vector2d& corner : label.corners)
      EXPECT_TRUE(labels[label.index].box_px.contains(corner));
  }
}

TEST(BoxLabels, StandLevelInLargeBoxes) {
  const auto labels = row_of_boxes(20, 80, 0.7);
  const auto placed = place_labels(labels, 20);
  EXPECT_EQ(placed.size(), 20u);
  expect_inside(labels, placed);
  EXPECT_EQ(placed[0].turn_rad, 0);
  EXPECT_EQ(placed[0].size_px, 20);
}

TEST(BoxLabels, TurnAlongNarrowBoxes) {
  const double heading = radians(130);
  const auto labels = row_of_boxes(20, 24, heading);
  const auto placed = place_labels(labels, 20);
  EXPECT_EQ(placed.size(), 20u);
  expect_inside(labels, placed);
  EXPECT_NEAR(placed[0].turn_rad, heading - std::numbers::pi, 1e-9) << "read from left to right";
}

TEST(BoxLabels, AreThinnedOutInSmallOnesButImportantOnesStay) {
  const auto labels = row_of_boxes(40, 6, 0);
  const auto placed = place_labels(labels, 20);
  EXPECT_GT(placed.size(), 2u);
  EXPECT_LT(placed.size(), 20u);
  EXPECT_EQ(placed.front().index, 7u);
  for (const PlacedLabel& a : placed) {
    for (const PlacedLabel& b : placed) {
      if (a.index == b.index) continue;
      const double apart = (labels[a.index].box_px.center - labels[b.index].box_px.center).norm();
      EXPECT_GE(apart, 20) << a.index << " and " << b.index;  // twice the text's height
    }
  }
}

}  // namespace
}  // namespace plotscan::view
