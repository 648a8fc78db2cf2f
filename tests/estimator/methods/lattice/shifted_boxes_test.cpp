// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/internal/shifted_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/random.h"

namespace plotscan::methods::lattice {
namespace {

constexpr double kNoise_m = 0.015;
constexpr double kWidth_m = 1.5, kLength_m = 4;

struct Sown {
  std::vector<PlotBox> boxes = {};  // where the plots are
  std::vector<Eigen::Vector3f> heights = {};
};

// 4 x 3 plots of 1.5 m x 4 m, seen with their surroundings by 300 returns a square metre; a third
// of those over plots reach the ground. Every second box is described the other way round.
Sown sown(double gap_m, double heading_rad = 0.3) {
  RandomStream random(4, random_purpose("test/shifted_boxes"), 0);
  const Eigen::Rotation2Dd turn(heading_rad);
  const Eigen::Vector2d step(kLength_m + gap_m, kWidth_m + gap_m);
  Sown field;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      field.boxes.push_back({.center = turn * Eigen::Vector2d(row * step.x(), column * step.y()),
                             .width_m = kWidth_m,
                             .length_m = kLength_m,
                             .heading_rad = heading_rad + (column % 2 == 0 ? 0 : kPi)});
    }
  }
  for (int i = 0; i < 76'000; ++i) {
    const Eigen::Vector2d at =
        turn * Eigen::Vector2d(random.uniform(-5, 14), random.uniform(-4, 10));
    const bool in_plot =
        std::ranges::any_of(field.boxes, [&](const PlotBox& box) { return box.contains(at); });
    const double height_m = in_plot && random.uniform() > 1.0 / 3 ? random.uniform(0.4, 0.7)
                                                                  : kNoise_m * random.normal();
    field.heights.emplace_back(at.x(), at.y(), height_m);
  }
  return field;
}

std::optional<ShiftedBoxes> seen_in(const Sown& field, const Eigen::Vector2d& moved) {
  std::vector<PlotBox> boxes = field.boxes;
  for (PlotBox& box : boxes) box.center += moved;
  return shifted_boxes(field.heights, boxes, kNoise_m);
}

TEST(ShiftedBoxes, AreToldWhereTheCanopyIs) {
  for (const double gap_m : {0.6, 1.5}) {
    const Sown field = sown(gap_m);
    for (const Eigen::Vector2d& by : {Eigen::Vector2d(0.8, 0.3), Eigen::Vector2d(-0.4, 0.6)}) {
      const auto seen = seen_in(field, by);
      ASSERT_TRUE(seen) << gap_m;
      EXPECT_LT((seen->by_m + by).norm(), 0.2) << seen->by_m.transpose();
      // Of cells with a return: 3 fall into each on average, 2 of them on canopy (Poisson).
      EXPECT_NEAR(seen->covered_there, (1 - std::exp(-2)) / (1 - std::exp(-3)), 0.05);
      EXPECT_LT(seen->covered, seen->covered_there - 0.1);
    }
  }
}

TEST(ShiftedBoxes, NothingIsSaidOfBoxesThatFit) {
  EXPECT_FALSE(seen_in(sown(0.6), {0, 0}));
  EXPECT_FALSE(seen_in(sown(0.6), {0.1, -0.1})) << "within what maps differ by";
}

// Nothing shows where plots end.
TEST(ShiftedBoxes, NothingIsSaidOfAClosedCanopy) {
  Sown field = sown(0);
  field.boxes = {field.boxes[5], field.boxes[6]};  // in the middle
  EXPECT_FALSE(seen_in(field, {0.3, 0.4}));
}

TEST(ShiftedBoxes, NothingIsSaidOfBareGround) {
  Sown field = sown(0.6);
  for (Eigen::Vector3f& point : field.heights) point.z() = std::min(point.z(), 0.03F);
  EXPECT_FALSE(seen_in(field, {0.8, 0.3}));
  EXPECT_FALSE(shifted_boxes(field.heights, {}, kNoise_m));
}

}  // namespace
}  // namespace plotscan::methods::lattice
