// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.h"

namespace plotscan::mesh {

// Height of the mesh's highest vertex over its origin, metres.
double mesh_height(const Mesh& mesh);

// The area of some or all triangles of a mesh, one-sided, for any scale of the mesh.
class ScaledArea {
 public:
  // The area of all triangles.
  explicit ScaledArea(const Mesh& mesh);
  // The area of the leaves: the triangles whose material's name says so (names_leaf), or all
  // triangles where no name does. A leaf is one sheet, so this is its one-sided area.
  static ScaledArea of_leaves(const Mesh& mesh);

  // Square metres with each axis scaled. Takes time in proportion to the number of triangles.
  double at(const Eigen::Vector3d& scale = Eigen::Vector3d::Ones()) const;

 private:
  ScaledArea() = default;
  void add(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle);

  // By axis, for each triangle: the squared coordinates of the cross product of its edges.
  std::array<std::vector<double>, 3> cross_squares_;
};

}  // namespace plotscan::mesh
