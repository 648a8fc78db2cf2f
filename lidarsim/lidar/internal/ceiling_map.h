// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library.

#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "mesh/mesh.h"

namespace plotscan::lidar {

// For each cell of a grid over a mesh's ground plane, a height that the mesh does not exceed in the
// cell or within `margin` of it.
class CeilingMap {
 public:
  static constexpr float kNothing = -std::numeric_limits<float>::infinity();

  CeilingMap(const mesh::Mesh& mesh, double margin);
  // The map that holds however the mesh is turned about its origin.
  static CeilingMap of_any_turn(const mesh::Mesh& mesh, double margin);

  // The ceiling at a place; kNothing where the mesh has nothing.
  float at(const Eigen::Vector2d& place) const { return at_cell(cell_of(place)); }

  // The place in units of cells from the grid's corner.
  Eigen::Vector2d cell_of(const Eigen::Vector2d& place) const {
    return cells_per_metre_ * (place - low_);
  }
  double cells_per_metre() const { return cells_per_metre_; }
  float at_cell(const Eigen::Vector2d& cell) const {
    // Written so that NaN counts as outside.
    const bool inside = cell.x() >= 0 && cell.y() >= 0 && cell.x() < columns_ && cell.y() < rows_;
    if (!inside) return kNothing;
    return ceilings_[static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(columns_) +
                     static_cast<std::size_t>(cell.x())];
  }
  // Nothing of the mesh, widened by `margin`, is farther than this from the origin along the
  // ground.
  double reach() const { return reach_; }

 private:
  CeilingMap(const Eigen::AlignedBox2d& box, double cells, double margin);
  void raise(const Eigen::AlignedBox3d& triangle, const Eigen::Vector3d& on_plane,
             const Eigen::Vector2d& gradient);

  double margin_;
  Eigen::Vector2d low_;
  double cells_per_metre_;
  double columns_, rows_;  // whole numbers
  double reach_ = 0;
  std::vector<float> ceilings_;  // row by row
};

}  // namespace plotscan::lidar
