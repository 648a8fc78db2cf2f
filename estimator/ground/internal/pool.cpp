// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/pool.h"

#include <algorithm>

namespace plotscan::ground {

void pool(const Grid& grid, int around, Field& field) {
  Field along(field.size());
  for_rows(grid, [&](int row) {
    for (int c = 0; c < grid.columns; ++c) {
      float sum = 0;
      for (int k = std::max(0, c - around); k <= std::min(grid.columns - 1, c + around); ++k) {
        sum += field[grid.index(k, row)];
      }
      along[grid.index(c, row)] = sum;
    }
  });
  for_rows(grid, [&](int row) {
    for (int c = 0; c < grid.columns; ++c) {
      float sum = 0;
      for (int k = std::max(0, row - around); k <= std::min(grid.rows - 1, row + around); ++k) {
        sum += along[grid.index(c, k)];
      }
      field[grid.index(c, row)] = sum;
    }
  });
}

}  // namespace plotscan::ground
