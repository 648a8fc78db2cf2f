// SPDX-License-Identifier: Apache-2.0
#include "terrain/triangle_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plotscan::terrain {
namespace {

using Corners = std::array<Eigen::Vector2d, 3>;

constexpr std::uint32_t kDivided = std::numeric_limits<std::uint32_t>::max();
// A cell over a well-shaped triangulation lists about 5 triangles.
constexpr std::size_t kManyTriangles = 24;
// Dividing does not pay where it would list each triangle in more cells than this (a fan of thin
// triangles about one vertex); it also bounds the memory.
constexpr std::size_t kMostCellsPerTriangle = 8;
constexpr int kMostLevels = 4;
constexpr double kMostCellsPerSide = 8192;
// Triangles are listed in every cell within this share of a cell, so that rounding loses none.
constexpr double kMargin = 1e-6;

// The cell of a grid coordinate; the first for NaN.
std::uint32_t cell_of(double coordinate, std::uint32_t size) {
  if (!(coordinate > 0)) return 0;
  return coordinate >= size ? size - 1 : static_cast<std::uint32_t>(coordinate);
}

// The x range of the part of the triangle that lies between y = low and y = high; empty where there
// is none.
Eigen::AlignedBox1d x_range_between(const Corners& corners, double low, double high) {
  Eigen::AlignedBox1d range;
  const auto extend = [&range](double x) { range.extend(Eigen::Matrix<double, 1, 1>(x)); };
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d& to = corners[(i + 1) % 3];
    if (from.y() >= low && from.y() <= high) extend(from.x());
    for (const double y : {low, high}) {
      if ((from.y() < y) == (to.y() < y)) continue;
      extend(from.x() + (y - from.y()) / (to.y() - from.y()) * (to.x() - from.x()));
    }
  }
  return range;
}

// Calls visit(column, row) for each cell of a grid of this size that the triangle (grid
// coordinates) overlaps.
template <class Visit>
void for_each_overlapped_cell(const Corners& corners, const std::array<std::uint32_t, 2>& size,
                              Visit visit) {
  const auto [low, high] = std::minmax({corners[0].y(), corners[1].y(), corners[2].y()});
  const std::uint32_t last_row = cell_of(high + kMargin, size[1]);
  for (std::uint32_t row = cell_of(low - kMargin, size[1]); row <= last_row; ++row) {
    const auto range = x_range_between(corners, row - kMargin, row + 1 + kMargin);
    if (range.isEmpty()) continue;
    const std::uint32_t last_column = cell_of(range.max().x() + kMargin, size[0]);
    for (std::uint32_t column = cell_of(range.min().x() - kMargin, size[0]); column <= last_column;
         ++column)
      visit(column, row);
  }
}

}  // namespace

struct TriangleGrid::Builder {
  TriangleGrid& grid;
  const std::vector<Eigen::Vector3d>& vertices;
  const std::vector<Triangle>& triangles;

  Corners corners_in(const Level& level, std::uint32_t triangle) const {
    Corners corners;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d world = vertices[triangles[triangle][i]].head<2>();
      corners[i] = (world - level.origin).cwiseProduct(level.cells_per_metre);
    }
    return corners;
  }

  // A grid over the box with about `count` cells, as square as the box allows.
  static Level level_over(const Eigen::AlignedBox2d& box, std::size_t count) {
    const Eigen::Vector2d extent = box.sizes();
    const double cell_side = std::sqrt(extent.prod() / static_cast<double>(count));
    Level level{.origin = box.min(), .cells_per_metre = {}, .size = {}, .first_cell = 0};
    for (int axis = 0; axis < 2; ++axis) {
      const double cells = std::clamp(std::ceil(extent[axis] / cell_side), 1.0, kMostCellsPerSide);
      level.size[axis] = static_cast<std::uint32_t>(cells);
      level.cells_per_metre[axis] = cells / extent[axis];
    }
    return level;
  }

  // The triangles over each cell of the level, row by row.
  std::vector<std::vector<std::uint32_t>> sort_into(const Level& level,
                                                    const std::vector<std::uint32_t>& among) const {
    std::vector<std::vector<std::uint32_t>> lists(std::size_t{level.size[0]} * level.size[1]);
    for (const std::uint32_t triangle : among) {
      for_each_overlapped_cell(
          corners_in(level, triangle), level.size, [&](std::uint32_t column, std::uint32_t row) {
            lists[std::size_t{row} * level.size[0] + column].push_back(triangle);
          });
    }
    return lists;
  }

  Cell list(const std::vector<std::uint32_t>& among) {
    const auto begin = static_cast<std::uint32_t>(grid.listed_.size());
    grid.listed_.insert(grid.listed_.end(), among.begin(), among.end());
    return {begin, static_cast<std::uint32_t>(grid.listed_.size())};
  }

  // Lists the triangles, or divides the box among the cells of a new level.
  Cell divide(const Eigen::AlignedBox2d& box, const std::vector<std::uint32_t>& among, int depth) {
    if (depth > 0 && (among.size() < kManyTriangles || depth == kMostLevels)) return list(among);
    Level level = level_over(box, among.size());
    const auto lists = sort_into(level, among);
    std::size_t total = 0;
    for (const auto& cell : lists) total += cell.size();
    if (depth > 0 && total > kMostCellsPerTriangle * among.size()) return list(among);

    const auto index = static_cast<std::uint32_t>(grid.levels_.size());
    level.first_cell = static_cast<std::uint32_t>(grid.cells_.size());
    grid.levels_.push_back(level);
    grid.cells_.resize(grid.cells_.size() + lists.size());
    const Eigen::Vector2d cell_size = level.cells_per_metre.cwiseInverse();
    for (std::size_t i = 0; i < lists.size(); ++i) {
      const std::size_t row = i / level.size[0];
      const std::size_t column = i % level.size[0];
      const Eigen::Vector2d corner(static_cast<double>(column), static_cast<double>(row));
      const Eigen::Vector2d low = level.origin + corner.cwiseProduct(cell_size);
      const Cell cell = divide({low, low + cell_size}, lists[i], depth + 1);
      grid.cells_[level.first_cell + i] = cell;
    }
    return {index, kDivided};
  }
};

TriangleGrid::TriangleGrid(const std::vector<Eigen::Vector3d>& vertices,
                           const std::vector<Triangle>& triangles) {
  Eigen::AlignedBox2d box;
  std::vector<std::uint32_t> all(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    all[i] = i;
    for (const std::uint32_t vertex : triangles[i])
      box.extend(Eigen::Vector2d(vertices[vertex].head<2>()));
  }
  Builder{*this, vertices, triangles}.divide(box, all, 0);
}

std::span<const std::uint32_t> TriangleGrid::candidates(double x, double y) const {
  const Eigen::Vector2d point(x, y);
  Cell cell{0, kDivided};
  while (cell.end == kDivided) {
    const Level& level = levels_[cell.begin];
    const Eigen::Vector2d place = (point - level.origin).cwiseProduct(level.cells_per_metre);
    const std::uint32_t column = cell_of(place.x(), level.size[0]);
    const std::uint32_t row = cell_of(place.y(), level.size[1]);
    cell = cells_[level.first_cell + row * level.size[0] + column];
  }
  return std::span(listed_).subspan(cell.begin, cell.end - cell.begin);
}

}  // namespace plotscan::terrain
