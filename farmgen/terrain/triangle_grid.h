// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plotscan::terrain {

// Finds the triangles that may lie over a point of the horizontal plane. A grid of about one cell a
// triangle lists the triangles over each cell; a cell that lists many (a patch of fine triangles in
// a coarse terrain) is divided by a grid of its own, so that a look-up costs about the same
// everywhere.
class TriangleGrid {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  TriangleGrid(const std::vector<Eigen::Vector3d>& vertices,
               const std::vector<Triangle>& triangles);

  // Indices of triangles: at least all of those over (x, y). For a point outside the triangles'
  // bounding rectangle (or NaN), those of some cell of the border.
  std::span<const std::uint32_t> candidates(double x, double y) const;

 private:
  struct Level {
    Eigen::Vector2d origin;
    Eigen::Vector2d cells_per_metre;
    std::array<std::uint32_t, 2> size;  // cells along x and y
    std::uint32_t first_cell;
  };
  // Either the list listed_[begin .. end), or, if end == kDivided, divided by level `begin`.
  struct Cell {
    std::uint32_t begin;
    std::uint32_t end;
  };
  struct Builder;

  std::vector<Level> levels_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> listed_;
};

}  // namespace plotscan::terrain
