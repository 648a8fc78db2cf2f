// SPDX-License-Identifier: Apache-2.0
#include "ground/columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "core/error.h"
#include "random_fields.h"

namespace plotscan::ground {
namespace {

// Points on a square from (0, 0), about a sloping plane.
std::vector<Eigen::Vector3f> sloping_points(int count, double side_m) {
  RandomStream random(2, random_purpose("test/sloping"), 0);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(0, side_m), y = random.uniform(0, side_m);
    points.push_back(
        Eigen::Vector3d(x, y, 40 + 0.2 * x - 0.1 * y + 0.3 * random.uniform()).cast<float>());
  }
  return points;
}

// Two points a cell, no narrower than 0.2 m and no wider than 10 m.
TEST(CellFor, HoldsTwoPoints) {
  EXPECT_NEAR(cell_for(2), 1, 1e-12);
  EXPECT_NEAR(cell_for(0.5), 2, 1e-12);
  EXPECT_EQ(cell_for(5000), 0.2);
  EXPECT_EQ(cell_for(1e-6), 10);
}

TEST(GridOf, CoversTheSurveyAndNotWhatIsStrayOrSparse) {
  std::vector<Eigen::Vector3f> points = sloping_points(40000, 20);
  points.emplace_back(95.0f, 3.0f, 0.0f);   // a stray
  points.emplace_back(-30.0f, 8.0f, 0.0f);  // and one more
  points.reserve(points.size() + 40);
  for (int i = 0; i < 40; ++i)  // a sparse fringe, 1 % as dense as the field
    points.emplace_back(20.0f + static_cast<float>(i), 5.0f, 40.0f);
  const Grid grid = grid_of(points, std::nullopt);
  EXPECT_EQ(grid.cell_m, 0.2);
  EXPECT_NEAR(grid.origin.x(), 0, 1);
  EXPECT_NEAR(grid.origin.y(), 0, 1);
  EXPECT_NEAR(grid.origin.x() + grid.cell_m * (grid.columns - 1), 20, 1.5);
  EXPECT_NEAR(grid.origin.y() + grid.cell_m * (grid.rows - 1), 20, 1.5);
}

TEST(GridOf, RefusesAFieldThatIsTooLarge) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 2000; ++i)
    points.emplace_back(static_cast<float>(i), static_cast<float>((i * 7) % 2000), 0.0f);
  EXPECT_THROW(grid_of(points, 0.001), InputError);
}

TEST(SortIntoColumns, PutsEachPointAtItsNearestNode) {
  std::vector<Eigen::Vector3f> points = sloping_points(3000, 4);
  points.emplace_back(std::numeric_limits<float>::quiet_NaN(), 1.0f, 1.0f);
  points.emplace_back(1.0f, 1.0f, std::numeric_limits<float>::infinity());
  points.emplace_back(500.0f, 1.0f, 1.0f);
  const Grid grid{.origin = {0.3, 0.2}, .cell_m = 0.25, .columns = 13, .rows = 11};
  std::map<std::size_t, std::vector<Eigen::Vector3f>> expected;
  for (const Eigen::Vector3f& point : points) {
    const double column = std::floor((point.x() - 0.3) / 0.25 + 0.5);
    const double row = std::floor((point.y() - 0.2) / 0.25 + 0.5);
    if (!point.allFinite() || column < 0 || row < 0 || column > 12 || row > 10) continue;
    expected[grid.index(static_cast<int>(column), static_cast<int>(row))].push_back(point);
  }
  for (const int threads : {1, 2, 3}) {
    Columns columns;
    tbb::task_arena(threads).execute([&] { columns = sort_into_columns(points, grid); });
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const std::size_t node = grid.index(column, row);
        ASSERT_EQ(columns.at(node).size(), expected[node].size());
        for (std::size_t k = 0; k < expected[node].size(); ++k) {  // in the order of the points
          const Return& here = columns.at(node)[k];
          const double east_m = 0.25 * (column + here.east());
          const double north_m = 0.25 * (row + here.north());
          EXPECT_NEAR(0.3 + east_m, expected[node][k].x(), 1e-4);
          EXPECT_NEAR(0.2 + north_m, expected[node][k].y(), 1e-4);
          const double base =
              columns.base.z_m + columns.base.slope.dot(Eigen::Vector2d(east_m, north_m));
          EXPECT_NEAR(base + here.z_m, expected[node][k].z(), 1e-4);
        }
      }
    }
  }
}

TEST(SortIntoColumns, MeasuresHeightsFromThePlane) {
  const std::vector<Eigen::Vector3f> points = sloping_points(20000, 8);
  const Columns columns = sort_into_columns(points, grid_of(points, 0.2));
  EXPECT_NEAR(columns.base.slope.x(), 0.2, 0.01);
  EXPECT_NEAR(columns.base.slope.y(), -0.1, 0.01);
  for (const Return& here : columns.returns) EXPECT_LT(std::abs(here.z_m), 0.2);
}

std::vector<float> heights_at(const Columns& columns, std::size_t node) {
  std::vector<float> heights;
  for (const Return& here : columns.at(node)) heights.push_back(here.z_m);
  return heights;
}

TEST(LowPart, KeepsWhatLiesNearTheLowestHundredth) {
  const Grid grid{.cell_m = 0.2, .columns = 6, .rows = 5};
  const Columns all = columns_with(grid, 250, 1, [](RandomStream& r) { return r.uniform(0, 3); });
  const Columns low = low_part(all, 0.5f);
  for (std::size_t node = 0; node < grid.nodes(); ++node) {
    std::vector<float> expected = heights_at(all, node), sorted = expected;
    std::ranges::sort(sorted);
    std::erase_if(expected, [&](float z) { return z > sorted[2] + 0.5f; });
    EXPECT_EQ(heights_at(low, node), expected);
  }
}

TEST(LowPart, ThinsBareColumnsEvenly) {
  const Grid grid{.cell_m = 0.2, .columns = 3, .rows = 3};
  const Columns all = columns_with(grid, 640, 1, [](RandomStream& r) { return r.uniform(0, 0.1); });
  const Columns low = low_part(all, 0.5f);
  for (std::size_t node = 0; node < grid.nodes(); ++node) {
    const std::vector<float> before = heights_at(all, node), after = heights_at(low, node);
    ASSERT_EQ(after.size(), 64u);
    for (std::size_t k = 0; k < after.size(); ++k) EXPECT_EQ(after[k], before[10 * k]);
  }
}

TEST(NearPart, KeepsWhatLiesNearTheSurface) {
  const Grid grid{.cell_m = 0.2, .columns = 5, .rows = 4};
  const Columns all = columns_with(grid, 90, 3, [](RandomStream& r) { return r.uniform(-1, 2); });
  const Field surface = random_field(grid, "test/near", 0, 1);
  std::vector<std::uint8_t> whole(grid.nodes(), 0);
  whole[7] = 1;
  const Columns near = near_part(all, surface, -0.2f, 0.4f, whole);
  for (std::size_t node = 0; node < grid.nodes(); ++node) {
    std::vector<float> expected = heights_at(all, node);
    const float z = surface[node];
    if (node != 7)
      std::erase_if(expected, [&](float h) { return !(h > z - 0.2f && h < z + 0.4f); });
    EXPECT_EQ(heights_at(near, node), expected);
  }
}

}  // namespace
}  // namespace plotscan::ground
