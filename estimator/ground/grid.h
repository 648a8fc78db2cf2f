// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace plotscan::ground {

// A square grid of nodes: (column, row) lies at origin + cell_m * (column, row) and has index
// row * columns + column.
struct Grid {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // in the points' frame, metres
  double cell_m = 0;
  int columns = 0;
  int rows = 0;

  std::size_t nodes() const { return static_cast<std::size_t>(columns) * rows; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * columns + column;
  }
};

// A number for each node of a grid.
using Field = std::vector<float>;

// Calls body(node) for the nodes of a square that reaches `around` nodes to either side.
template <class Body>
void for_around(const Grid& grid, int column, int row, int around, const Body& body) {
  const int west = std::max(0, column - around), east = std::min(grid.columns - 1, column + around);
  const int south = std::max(0, row - around), north = std::min(grid.rows - 1, row + around);
  for (int r = south; r <= north; ++r)
    for (int c = west; c <= east; ++c) body(grid.index(c, r));
}

// Calls body(row) for every row, rows at the same time: a body may write nothing but its own row.
template <class Body>
void for_rows(const Grid& grid, const Body& body) {
  constexpr int kRowsAtOnce = 8;
  tbb::parallel_for(tbb::blocked_range<int>(0, grid.rows, kRowsAtOnce),
                    [&](const tbb::blocked_range<int>& rows) {
                      for (int row = rows.begin(); row < rows.end(); ++row) body(row);
                    });
}

}  // namespace plotscan::ground
