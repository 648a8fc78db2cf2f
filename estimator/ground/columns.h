// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "ground/grid.h"

namespace plotscan::ground {

// A return, stored with the node that it is nearest to: it lies in the square of edge cell_m about
// it.
struct Return {
  float z_m = 0;        // relative to Columns::base
  std::int16_t dx = 0;  // from the node, in 1/65536 of a cell
  std::int16_t dy = 0;

  float east() const { return static_cast<float>(dx) * kCells; }  // from the node, in cells
  float north() const { return static_cast<float>(dy) * kCells; }
  static constexpr float kCells = 1.0f / 65536;
};

// The plane from which heights are measured, so that floats stay precise on a slope. Metres.
struct BasePlane {
  double z_m = 0;  // at the grid's origin
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
};

// A field's returns sorted by the node that they lie nearest to, in the order of the points.
struct Columns {
  Grid grid;
  BasePlane base;
  std::vector<std::uint32_t> first = {};  // of each node's returns; one more at the end
  std::vector<Return> returns = {};

  std::span<const Return> at(std::size_t node) const {
    return std::span<const Return>(returns).subspan(first[node], first[node + 1] - first[node]);
  }
};

// The width of the grid's cells, metres, for a typical density (points per square metre): a cell
// usually holds a few points, and is 0.2 to 10 m wide.
double cell_for(double density_m2);

// The grid over the densely surveyed area; sparse surroundings and stray points lie outside it.
// Without cell_m, cells are as wide as cell_for says.
Grid grid_of(std::span<const Eigen::Vector3f> points, std::optional<double> cell_m);

// The points on the grid. Those that are not finite or outside of it are left out.
Columns sort_into_columns(std::span<const Eigen::Vector3f> points, const Grid& grid);

// The returns needed to find the ground: those at most reach_m above the lowest hundredth of their
// column. Of a column in which all returns are that low, only a sample that is large enough.
Columns low_part(Columns columns, float reach_m);

// Without the returns of the nodes at which `nodes` is not 0.
Columns without(Columns columns, const std::vector<std::uint8_t>& nodes);

// The returns whose height above a surface lies between low_m and high_m; at nodes where `whole` is
// not 0, all returns.
Columns near_part(Columns columns, const Field& surface, float low_m, float high_m,
                  const std::vector<std::uint8_t>& whole);

}  // namespace plotscan::ground
