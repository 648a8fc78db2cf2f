// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plotscan::terrain {

// Points in rows, every other row shifted by half a step: no four neighbours lie on one circle, so
// that their Delaunay triangulation is unique, and directions are covered more evenly than by
// squares.
struct Lattice {
  Eigen::Vector2d origin;  // of row 0 and column 0, world frame, metres
  Eigen::Vector2d along;   // from column to column
  Eigen::Vector2d across;  // from row to row, perpendicular to `along`
  Eigen::Index rows = 0;
  Eigen::Index columns = 0;

  Eigen::Vector2d row_start(Eigen::Index row) const {
    return origin + static_cast<double>(row) * across + (row % 2 == 0 ? 0.0 : 0.5) * along;
  }
  Eigen::Vector2d point(Eigen::Index row, Eigen::Index column) const {
    return row_start(row) + static_cast<double>(column) * along;
  }
};

// How a lattice lies: its rows' direction and the distances between points and between rows. Some
// row passes through a point that is offset_m beside the world's origin, across the rows.
struct LatticeLayout {
  double heading_rad = 0;
  double column_step_m = 1;
  double row_step_m = 1;
  double offset_m = 0;
};

// A lattice that covers the box, and, where the box is turned against it, some of its surroundings.
Lattice lattice_over(const Eigen::AlignedBox2d& box, const LatticeLayout& layout);

}  // namespace plotscan::terrain
