// SPDX-License-Identifier: Apache-2.0
#pragma once

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

  // The place in units of cells from the grid's corner.
  Eigen::Vector2d cell_of(const Eigen::Vector2d& place) const {
    return cells_per_metre_ * (place - low_);
  }
  double cells_per_metre() const { return cells_per_metre_; }

  // From the first to the last k for which a place, start + k * step in units of cells, is on the
  // grid; the first is greater than the last if there is none. Beside these places the mesh has
  // nothing.
  struct Steps {
    double first, last;
  };
  Steps steps_over(const Eigen::Vector2d& start, const Eigen::Vector2d& step) const;
  // The ceiling at a place on the grid, in units of cells; kNothing if the mesh has nothing there.
  float at_cell(const Eigen::Vector2d& cell) const {
    const auto row = static_cast<std::ptrdiff_t>(cell.y());
    const auto column = static_cast<std::ptrdiff_t>(cell.x());
    return ceilings_[static_cast<std::size_t>(row * whole_columns_ + column)];
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
  std::ptrdiff_t whole_columns_;
  double reach_ = 0;
  std::vector<float> ceilings_;  // row by row
};

}  // namespace plotscan::lidar
