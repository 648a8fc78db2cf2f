// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "core/random.h"
#include "ground/columns.h"
#include "ground/grid.h"

namespace plotscan::ground {

// A number between low and high for each node.
inline Field random_field(const Grid& grid, std::string_view what, double low, double high) {
  RandomStream random(7, random_purpose(what), 0);
  Field field(grid.nodes());
  for (float& value : field) value = static_cast<float>(random.uniform(low, high));
  return field;
}

// A field that takes node (column, row) to value(column, row).
inline Field field_of(const Grid& grid, const std::function<double(int, int)>& value) {
  Field field(grid.nodes());
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column)
      field[grid.index(column, row)] = static_cast<float>(value(column, row));
  }
  return field;
}

// Columns of `returns` each, whose heights are height(random), at random places in the cell.
inline Columns columns_with(const Grid& grid, int returns, std::uint64_t seed,
                            const std::function<double(RandomStream&)>& height) {
  RandomStream random(seed, random_purpose("test/columns"), 0);
  Columns columns{.grid = grid, .base = {}};
  for (std::size_t node = 0; node <= grid.nodes(); ++node)
    columns.first.push_back(static_cast<std::uint32_t>(node) * returns);
  while (columns.returns.size() < columns.first.back()) {
    const auto at = [&] { return static_cast<std::int16_t>(random.uniform(-32768, 32767)); };
    columns.returns.push_back({.z_m = static_cast<float>(height(random)), .dx = at(), .dy = at()});
  }
  return columns;
}

}  // namespace plotscan::ground
