// SPDX-License-Identifier: Apache-2.0
#include "core/extent.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/angle.h"

namespace plotscan {
namespace {

TEST(ExtentOf, HoldsTheCornersOfAll) {
  struct Item {
    PlotBox outline;
  };
  // A square on its corner, and a rectangle along the axes.
  const std::vector<Item> items = {
      {{.center = {1, 2}, .width_m = 2, .length_m = 2, .heading_rad = kPi / 4}},
      {{.center = {5, 0}, .width_m = 2, .length_m = 4, .heading_rad = kPi / 2}}};
  const Eigen::AlignedBox2d extent = extent_of(items, &Item::outline);
  EXPECT_LT((extent.min() - Eigen::Vector2d(1 - std::sqrt(2), -2)).norm(), 1e-12);
  EXPECT_LT((extent.max() - Eigen::Vector2d(6, 2 + std::sqrt(2))).norm(), 1e-12);
  EXPECT_TRUE(extent_of(std::vector<PlotBox>{}).isEmpty());
  // In the frame of the square, whose x is its heading.
  const std::vector<PlotBox> square = {items[0].outline};
  const Eigen::AlignedBox2d turned =
      extent_of(square, std::identity{}, Eigen::Rotation2Dd(-kPi / 4));
  EXPECT_LT((turned.sizes() - Eigen::Vector2d(2, 2)).norm(), 1e-12);
}

}  // namespace
}  // namespace plotscan
