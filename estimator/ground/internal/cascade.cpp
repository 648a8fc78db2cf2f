// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/cascade.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace plotscan::ground {
namespace {

// Every second node, and one beyond the last.
Grid half_as_fine(const Grid& grid) {
  return {.origin = grid.origin,
          .cell_m = 2 * grid.cell_m,
          .columns = grid.columns / 2 + 1,
          .rows = grid.rows / 2 + 1};
}

// Calls body(node of the grid, node of the coarse one, weight) for the coarse nodes between which a
// node is interpolated, bilinearly.
template <class Body>
void for_parents(const Grid& grid, const Grid& coarse, const Body& body) {
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const int east = column % 2, north = row % 2;
      const float weight = 1.0f / static_cast<float>((1 + east) * (1 + north));
      for (int r = 0; r <= north; ++r) {
        for (int c = 0; c <= east; ++c)
          body(grid.index(column, row), coarse.index(column / 2 + c, row / 2 + r), weight);
      }
    }
  }
}

Field restricted(const Grid& grid, const Grid& coarse, const Field& field) {
  Field sums(coarse.nodes(), 0);
  for_parents(grid, coarse, [&](std::size_t i, std::size_t parent, float weight) {
    sums[parent] += weight * field[i];
  });
  return sums;
}

Field interpolated(const Grid& grid, const Grid& coarse, const Field& field) {
  Field result(grid.nodes(), 0);
  for_parents(grid, coarse, [&](std::size_t i, std::size_t parent, float weight) {
    result[i] += weight * field[parent];
  });
  return result;
}

// Second differences are four times as large on the coarse grid, and a quarter as many: a quarter
// of the stiffness gives the same sum.
Fit half_as_fine(const Grid& grid, const Grid& coarse, const Fit& fit) {
  Fit half{.target = {},
           .data = restricted(grid, coarse, fit.data),
           .stiffness = restricted(grid, coarse, fit.stiffness)};
  const Field nodes = restricted(grid, coarse, Field(grid.nodes(), 1));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] > 0) half.stiffness[i] /= 4 * nodes[i];
  return half;
}

}  // namespace

Cascade::Cascade(const Grid& grid, Fit fit) {
  constexpr int kCoarsest = 8;  // nodes a side, which need few iterations
  levels_.push_back({grid, std::move(fit)});
  while (std::min(levels_.back().grid.columns, levels_.back().grid.rows) > kCoarsest) {
    const Level& fine = levels_.back();
    const Grid coarse = half_as_fine(fine.grid);
    levels_.push_back({coarse, half_as_fine(fine.grid, coarse, fine.fit)});
  }
}

Field Cascade::solve(const Field& right, const SolveOptions& options) const {
  std::vector<Field> rights{right};
  for (std::size_t i = 1; i < levels_.size(); ++i)
    rights.push_back(restricted(levels_[i - 1].grid, levels_[i].grid, rights.back()));
  Field surface(levels_.back().grid.nodes(), 0);
  for (std::size_t i = levels_.size(); i-- > 0;) {
    const auto& [grid, fit] = levels_[i];
    if (i + 1 < levels_.size()) surface = interpolated(grid, levels_[i + 1].grid, surface);
    solve_right_side(grid, fit, rights[i], options, surface);
  }
  return surface;
}

}  // namespace plotscan::ground
