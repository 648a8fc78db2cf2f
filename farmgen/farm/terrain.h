// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace plotscan::farm {

// A triangulated height field: z as a function of (x, y), world frame, metres. Immutable.
class Terrain {
 public:
  // Throws InputError when a vertex is not finite, a triangle names a missing vertex, or no
  // triangle has an area when seen from above. Triangles without such area are dropped.
  Terrain(std::vector<Eigen::Vector3d> vertices,
          std::vector<std::array<std::uint32_t, 3>> triangles);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }

  // Height of the surface at (x, y): exact at vertices and along edges; absent outside the
  // triangles. Constant expected time: a grid of about one cell a triangle lists the triangles over
  // each cell.
  std::optional<double> height(double x, double y) const;

 private:
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  // The grid over the triangles' bounding rectangle: cell c lists cell_triangles_[cell_begin_[c] ..
  // cell_begin_[c + 1]).
  Eigen::Vector2d grid_origin_;
  Eigen::Vector2d cells_per_metre_;
  std::array<std::uint32_t, 2> grid_size_{};
  std::vector<std::uint32_t> cell_begin_;
  std::vector<std::uint32_t> cell_triangles_;
};

}  // namespace plotscan::farm
