// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.h"
#include "terrain/triangle_grid.h"

namespace plotscan::terrain {

// The greatest coordinate of a farm, metres: the world frame is local.
inline constexpr double kFarthest_m = 1e5;

// A triangulated height field: z as a function of (x, y), world frame, metres. Immutable.
class Terrain {
 public:
  // Throws InputError when a vertex is not finite or lies beyond kFarthest_m, a triangle names a
  // missing vertex, or no triangle has an area when seen from above. Triangles without such area
  // are dropped, the others are turned to run counter-clockwise seen from above.
  Terrain(std::vector<Eigen::Vector3d> vertices,
          std::vector<std::array<std::uint32_t, 3>> triangles);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }

  // Height of the surface at (x, y), metres; the highest where triangles overlap. Exact at
  // vertices, exact except for rounding along edges; absent outside the triangles. Constant
  // expected time.
  std::optional<double> height(double x, double y) const;
  // The same, faster for a sequence of near places: looks first in `triangle` (initially any index)
  // and sets it to the triangle that holds the place. Where triangles overlap, the height of any of
  // them.
  std::optional<double> height_near(double x, double y, std::uint32_t& triangle) const;

 private:
  struct Place {
    double z = 0;
    double least_share = 0;  // of the triangle's corners; negative outside it
  };
  Place place_in(std::uint32_t triangle, const Eigen::Vector2d& point) const;

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  TriangleGrid grid_;
};

// Its surface as a mesh without materials.
mesh::Mesh mesh_of(const Terrain& terrain);

}  // namespace plotscan::terrain
