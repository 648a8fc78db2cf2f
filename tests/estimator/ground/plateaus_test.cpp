// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/plateaus.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"
#include "ground/surface.h"
#include "synthetic_field.h"

namespace plotscan::ground {
namespace {

constexpr float kNoReturn = std::numeric_limits<float>::infinity();
constexpr double kReturns_m = 0.01;

Grid grid_of_size(int columns, int rows) {
  return {.origin = {0, 0}, .cell_m = 0.2, .columns = columns, .rows = rows};
}

template <class Height>
Field heights(const Grid& grid, const Height& height) {
  Field z(grid.nodes());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      z[grid.index(column, row)] =
          static_cast<float>(height(grid.cell_m * column, grid.cell_m * row));
  return z;
}

int count(const std::vector<std::uint8_t>& nodes) {
  return std::accumulate(nodes.begin(), nodes.end(), 0);
}

// The highest level square below z on which the node lies, one square at a time.
float opened_at(const Grid& grid, const Field& z, int column, int row, int around) {
  float highest = -kNoReturn;
  for (int r = row - around; r <= row + around; ++r) {
    for (int c = column - around; c <= column + around; ++c) {
      float lowest = kNoReturn;
      for_around(grid, c, r, around, [&](std::size_t node) { lowest = std::min(lowest, z[node]); });
      if (lowest < kNoReturn) highest = std::max(highest, lowest);
    }
  }
  return highest;
}

float third_lowest_at(const Grid& grid, const Field& z, int column, int row) {
  std::vector<float> around;
  for_around(grid, column, row, 1, [&](std::size_t node) { around.push_back(z[node]); });
  std::sort(around.begin(), around.end());
  return around[2] < kNoReturn ? std::max(around[2], z[grid.index(column, row)])
                               : z[grid.index(column, row)];
}

TEST(Plateaus, AreThoseOfOneSquareAtATime) {
  const Grid grid = grid_of_size(22, 19);
  RandomStream random(1, random_purpose("test/plateaus"), 0);
  const Field z = heights(grid, [&](double x, double y) {
    if (random.uniform() < 0.05) return static_cast<double>(kNoReturn);
    const bool top = std::fmod(x, 1.7) < 1.1 && y > 0.6 && y < 3;
    return 0.2 * x + 0.1 * std::sin(y) + (top ? random.uniform(0.2, 0.6) : 0) +
           kReturns_m * random.normal();
  });
  Field lifted(grid.nodes());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      lifted[grid.index(column, row)] = third_lowest_at(grid, z, column, row);
  std::vector<int> raised(grid.nodes(), 0);
  const double step_m = 0.35 * std::sqrt(2) * grid.cell_m + 0.05 + 6 * kReturns_m;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t i = grid.index(column, row);
      float before = lifted[i];
      for (int around = 1; around <= 15; ++around) {
        const float below = opened_at(grid, lifted, column, row, around);
        if (z[i] < kNoReturn && before > below + step_m) raised[i] = 1;
        before = below;
      }
    }
  }
  const std::vector<std::uint8_t> found = plateaus(grid, z, kReturns_m);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      int seen = 0, among = 0;
      for_around(grid, column, row, 2, [&](std::size_t near) {
        seen += z[near] < kNoReturn ? 1 : 0;
        among += raised[near];
      });
      const std::size_t i = grid.index(column, row);
      ASSERT_EQ(found[i], raised[i] == 1 && 2 * among >= seen ? 1 : 0) << column << " " << row;
    }
  }
  EXPECT_GT(count(found), 40);
}

TEST(Plateaus, AreNoHillsTerracesOrSlopes) {
  const Grid grid = grid_of_size(120, 120);
  const auto hill = [](double x, double y) { return -0.3 * std::hypot(x - 12, y - 12); };
  const auto terraces = [](double x, double y) { return 0.5 * std::floor(x / 3) + 0.1 * y; };
  const auto slope = [](double x, double y) { return 1.5 * x - y; };
  EXPECT_EQ(count(plateaus(grid, heights(grid, hill), kReturns_m)), 0);
  EXPECT_EQ(count(plateaus(grid, heights(grid, terraces), kReturns_m)), 0);
  EXPECT_EQ(count(plateaus(grid, heights(grid, slope), kReturns_m)), 0);
}

TEST(Plateaus, AreLeftAsTheyAreWhereTheyAreFew) {
  const Grid grid = grid_of_size(100, 100);
  const auto tops = [&](int wanted) {
    return count(plateaus(
        grid,
        heights(grid,
                [&](double x, double y) {
                  return x < 2 * wanted && std::fmod(x, 2.0) < 1 && y > 9 && y < 11 ? 0.6 : 0.0;
                }),
        kReturns_m));
  };
  EXPECT_EQ(tops(3), 0);  // some 130 of 10,000 nodes
  EXPECT_GT(tops(10), 200);
}

// Plots whose smooth tops alone are seen, and close, as photogrammetry shows them.
TEST(FitSurface, IsTheGroundBetweenClosedTops) {
  const Terrain rolling = [](double x, double y) {
    return 0.1 * std::sin(0.6 * x) + 0.05 * std::cos(0.5 * y) + 0.03 * x;
  };
  for (const double tall_m : {0.4, 0.8, 1.6}) {
    const std::vector<PlotBox> plots = two_rows_of_plots();
    const Surface surface = fit_surface(returns_of({.terrain = rolling,
                                                    .noise_m = 0.01,
                                                    .plots = plots,
                                                    .canopy_low_m = tall_m - 0.01,
                                                    .canopy_high_m = tall_m + 0.01,
                                                    .gaps = 0}),
                                        SurfaceOptions());
    for (const PlotBox& plot : plots)
      EXPECT_NEAR(mean_error(surface, rolling, plot), 0, 0.05) << tall_m;
  }
}

}  // namespace
}  // namespace plotscan::ground
