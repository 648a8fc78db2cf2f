// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/pool.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "random_fields.h"

namespace plotscan::ground {
namespace {

double sum_around(const Grid& grid, const Field& field, int around, int column, int row) {
  double sum = 0;
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c)
      if (std::abs(c - column) <= around && std::abs(r - row) <= around)
        sum += field[grid.index(c, r)];
  }
  return sum;
}

TEST(Pool, SumsTheSquareAroundEachNode) {
  const Grid grid{.cell_m = 0.2, .columns = 13, .rows = 6};
  const Field field = random_field(grid, "test/pool", 0, 9);
  for (const int around : {0, 1, 2, 6, 20}) {
    Field pooled = field;
    pool(grid, around, pooled);
    for (int r = 0; r < grid.rows; ++r) {
      for (int c = 0; c < grid.columns; ++c)
        EXPECT_NEAR(pooled[grid.index(c, r)], sum_around(grid, field, around, c, r), 1e-3);
    }
  }
}

}  // namespace
}  // namespace plotscan::ground
