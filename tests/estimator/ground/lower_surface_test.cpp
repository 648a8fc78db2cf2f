// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/lower_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "random_fields.h"
#include "synthetic_field.h"

namespace plotscan::ground {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

// The length of the shortest way of steps to the 8 neighbours, in cells.
double chamfer_cells(int columns, int rows) {
  const int askew = std::min(std::abs(columns), std::abs(rows));
  return std::sqrt(2.0) * askew + std::max(std::abs(columns), std::abs(rows)) - askew;
}

double highest_under(const Grid& grid, const Field& z, double slope, int column, int row) {
  double highest = kInfinite;
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c)
      highest = std::min(
          highest, z[grid.index(c, r)] + slope * grid.cell_m * chamfer_cells(c - column, r - row));
  }
  return highest;
}

TEST(SlopeLimited, IsTheHighestSurfaceUnderAllNodes) {
  const Grid grid{.cell_m = 0.2, .columns = 17, .rows = 12};
  Field z = random_field(grid, "test/layers", 0, 4);
  for (std::size_t i = 0; i < z.size(); i += 3) z[i] = kInfinite;
  for (const double slope : {0.5, 2.5}) {
    const Field limited = slope_limited(grid, z, slope);
    for (int r = 0; r < grid.rows; ++r) {
      for (int c = 0; c < grid.columns; ++c)
        EXPECT_NEAR(limited[grid.index(c, r)], highest_under(grid, z, slope, c, r), 1e-4);
    }
  }
}

TEST(UprightLayer, FindsTheGroundUnderLeaves) {
  const Grid grid{.cell_m = 0.2, .columns = 10, .rows = 10};
  const Columns columns = columns_with(grid, 120, 5, [](RandomStream& random) {
    return random.uniform() < 0.5 ? 0.02 * random.normal() : random.uniform(0.4, 0.8);
  });
  const Layer layer = upright_layer(columns, 0.02);
  double sum = 0, returns = 0, scatter = 0;
  for (std::size_t i = 0; i < grid.nodes(); ++i) {
    EXPECT_NEAR(layer.z_m[i], 0, 0.02);
    EXPECT_GT(layer.weight[i], 0.9);
    sum += layer.z_m[i];
    returns += layer.returns[i];
    scatter += layer.scatter[i];
  }
  const auto nodes = static_cast<double>(grid.nodes());
  EXPECT_NEAR(sum / nodes, 0, 0.002);
  EXPECT_NEAR(returns / nodes, 60, 2);
  EXPECT_NEAR(std::sqrt(scatter / nodes), 0.02, 0.001);
}

// Returns right above a layer make it doubtful: of leaves at all heights, as many lie 3 to 9 sigma
// above the layer's middle as within 3. The share is a half, the weight its square.
TEST(UprightLayer, DoubtsALayerThatHasReturnsRightAbove) {
  const Grid grid{.cell_m = 0.2, .columns = 8, .rows = 8};
  const Columns columns =
      columns_with(grid, 4000, 6, [](RandomStream& random) { return random.uniform(0, 1); });
  double sum = 0;
  for (const float weight : upright_layer(columns, 0.02).weight) sum += weight;
  EXPECT_NEAR(sum / static_cast<double>(grid.nodes()), 0.25, 0.05);
}

TEST(UprightLayer, HasNoneWhereThereIsNoReturn) {
  const Grid grid{.cell_m = 0.2, .columns = 3, .rows = 3};
  const Layer layer =
      upright_layer(columns_with(grid, 0, 1, [](RandomStream&) { return 0; }), 0.02);
  EXPECT_EQ(layer.z_m, Field(grid.nodes(), kInfinite));
  EXPECT_EQ(layer.weight, Field(grid.nodes(), 0));
}

// Ground that is seen through a fifth of the plots' canopies: the lower surface lies on it within a
// few sigma, below the plots too.
TEST(LowerSurface, StaysUnderCanopies) {
  const Terrain level = [](double, double) { return 0.0; };
  const auto points = returns_of({.terrain = level, .plots = two_rows_of_plots()});
  const Columns columns = sort_into_columns(points, grid_of(points, 0.2));
  const Field surface = lower_surface(columns, upright_layer(columns, 0.03), 0.03);
  const Eigen::Vector2d slope = columns.base.slope;
  for (int row = 0; row < columns.grid.rows; ++row) {
    for (int column = 0; column < columns.grid.columns; ++column) {
      const Eigen::Vector2d from_origin = columns.grid.cell_m * Eigen::Vector2d(column, row);
      const double z =
          columns.base.z_m + slope.dot(from_origin) + surface[columns.grid.index(column, row)];
      EXPECT_NEAR(z, 0, 0.09) << column << ", " << row;
    }
  }
}

// A ridge half a metre high and 1.25 m wide: the surface through the layers follows it, the
// lower one cuts it off.
TEST(LayerSurface, FollowsARidgeThatTheLowerSurfaceCutsOff) {
  const Grid grid{.cell_m = 0.2, .columns = 41, .rows = 41};
  const Terrain ridge = [](double x, double) { return std::max(0.0, 0.5 - 0.8 * std::abs(x)); };
  RandomStream random(9, random_purpose("test/ridge"), 0);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 60000; ++i) {
    const double x = random.uniform(-4.1, 4.1), y = random.uniform(-4.1, 4.1);
    points.push_back(Eigen::Vector3d(x, y, ridge(x, y) + 0.02 * random.normal()).cast<float>());
  }
  Grid about_origin = grid;
  about_origin.origin = {-4, -4};
  const Columns columns = sort_into_columns(points, about_origin);
  const Layer upright = upright_layer(columns, 0.02);
  const Field lower = lower_surface(columns, upright, 0.02);
  const LayerSurface layers = layer_surface(columns, upright, 0.02);
  const auto height_m = [&](const Field& surface, int row) {  // on the ridge, the grid's middle
    const Eigen::Vector2d from_origin = grid.cell_m * Eigen::Vector2d(20, row);
    return columns.base.z_m + columns.base.slope.dot(from_origin) + surface[grid.index(20, row)];
  };
  for (int row = 5; row <= 35; ++row) {
    EXPECT_NEAR(height_m(layers.z_m, row), 0.5, 0.12);
    EXPECT_LT(height_m(lower, row), 0.1);
  }
}

// An echo of a bird's flight below the ground is no layer.
TEST(LayerSurface, LeavesStraysOut) {
  const Grid grid{.cell_m = 0.2, .columns = 15, .rows = 15};
  Columns columns =
      columns_with(grid, 40, 8, [](RandomStream& random) { return 0.02 * random.normal(); });
  const std::size_t stray = grid.index(7, 7);
  for (std::uint32_t k = columns.first[stray]; k < columns.first[stray + 1]; ++k)
    columns.returns[k].z_m -= 3;
  const LayerSurface layers = layer_surface(columns, upright_layer(columns, 0.02), 0.02);
  EXPECT_EQ(layers.layer.z_m[stray], kInfinite);
  EXPECT_EQ(layers.layer.weight[stray], 0);
  EXPECT_NEAR(layers.z_m[stray], 0, 0.02);
}

}  // namespace
}  // namespace plotscan::ground
