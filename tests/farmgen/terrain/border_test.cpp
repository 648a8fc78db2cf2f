// SPDX-License-Identifier: Apache-2.0
#include "terrain/border.h"

#include <gtest/gtest.h>

namespace plotscan::terrain {
namespace {

// 8 x 8 squares of 1 m, from (0, 0) on, without the triangles of the square from (5, 5) to (6, 6).
Terrain square_with_hole() {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t row = 0; row <= 8; ++row) {
    for (std::uint32_t column = 0; column <= 8; ++column) {
      vertices.emplace_back(column, row, 0.1 * column);
      if (row == 8 || column == 8 || (row == 5 && column == 5)) continue;
      const std::uint32_t corner = 9 * row + column;
      triangles.push_back({corner, corner + 1, corner + 10});
      triangles.push_back({corner, corner + 10, corner + 9});
    }
  }
  return {vertices, triangles};
}

bool may_meet(double low_x, double low_y, double side_m) {
  const Eigen::Vector2d low(low_x, low_y);
  return Border(square_with_hole()).may_meet({low, low + Eigen::Vector2d(side_m, side_m)});
}

TEST(Border, IsTheOutlineAndThatOfAHole) {
  EXPECT_FALSE(may_meet(0.1, 0.1, 4.8));
  EXPECT_TRUE(may_meet(-0.1, 2, 1));
  EXPECT_TRUE(may_meet(7.5, 7.5, 1));
  EXPECT_TRUE(may_meet(4.5, 4.5, 1));
  EXPECT_TRUE(may_meet(5.5, 2, 3.2));  // one side alone
  EXPECT_FALSE(may_meet(6.1, 5, 1.5));
}

TEST(Border, IsNowhereInTheHoleOrFarOutside) {
  EXPECT_FALSE(may_meet(5.2, 5.2, 0.5));
  EXPECT_FALSE(may_meet(9, 9, 3));
}

}  // namespace
}  // namespace plotscan::terrain
