// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::lidar {

// A grid of vertical rays over a plot's box, each in the middle of its cell. A line of rays runs
// along the box's width; lines follow each other along its length.
struct RayGrid {
  PlotBox box;
  std::size_t lines = 1;
  std::size_t rays_a_line = 1;
  Eigen::Vector2d length_axis, width_axis;

  // Cells are at most step_m wide.
  RayGrid(const PlotBox& plot_box, double step_m)
      : box(plot_box),
        lines(cells(plot_box.length_m, step_m)),
        rays_a_line(cells(plot_box.width_m, step_m)),
        length_axis(plot_box.length_axis()),
        width_axis(plot_box.width_axis()) {}

  std::size_t rays() const { return lines * rays_a_line; }

  Eigen::Vector2d place(std::size_t line, std::size_t ray) const {
    return box.center + middle(line, lines) * box.length_m * length_axis +
           middle(ray, rays_a_line) * box.width_m * width_axis;
  }
  // `ray` is counted through all lines.
  Eigen::Vector2d place(std::size_t ray) const {
    return place(ray / rays_a_line, ray % rays_a_line);
  }

 private:
  static std::size_t cells(double side_m, double step_m) {
    constexpr double kRounding =
        1e-9;  // 1.5 m are 150 steps of 0.01 m, whatever doubles make of it
    return std::max<std::size_t>(
        1, static_cast<std::size_t>(std::ceil(side_m / step_m * (1 - kRounding))));
  }
  // The middle of a cell, measured from the side's middle, as a share of the side.
  static double middle(std::size_t cell, std::size_t count) {
    return (static_cast<double>(cell) + 0.5) / static_cast<double>(count) - 0.5;
  }
};

}  // namespace plotscan::lidar
