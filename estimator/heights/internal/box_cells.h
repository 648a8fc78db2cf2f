// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::heights {

// A plot's box divided into equal cells, about as wide as asked for; all cells lie wholly in the
// box.
class BoxCells {
 public:
  BoxCells(const PlotBox& box, double cell_m)
      : box_(box),
        along_(parts(box.length_m, cell_m)),
        across_(parts(box.width_m, cell_m)),
        length_axis_(box.length_axis()),
        width_axis_(box.width_axis()) {}

  std::size_t count() const {
    return static_cast<std::size_t>(along_) * static_cast<std::size_t>(across_);
  }
  // Index of the cell that holds the point, or is nearest to it; counted along rows across the
  // plot.
  std::size_t index(const Eigen::Vector3f& point) const {
    const Eigen::Vector2d from_center = point.head<2>().cast<double>() - box_.center;
    const int i = place(from_center.dot(length_axis_) / box_.length_m, along_);
    const int j = place(from_center.dot(width_axis_) / box_.width_m, across_);
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(across_) +
           static_cast<std::size_t>(j);
  }

  // The indices of that cell and of the cells that touch it.
  std::vector<std::size_t> around(std::size_t index) const {
    const int i = static_cast<int>(index) / across_;
    const int j = static_cast<int>(index) % across_;
    std::vector<std::size_t> near;
    for (int a = std::max(0, i - 1); a <= std::min(along_ - 1, i + 1); ++a)
      for (int b = std::max(0, j - 1); b <= std::min(across_ - 1, j + 1); ++b)
        near.push_back(static_cast<std::size_t>(a) * static_cast<std::size_t>(across_) +
                       static_cast<std::size_t>(b));
    return near;
  }

 private:
  static int parts(double side_m, double cell_m) {
    return std::max(1, static_cast<int>(std::lround(side_m / cell_m)));
  }
  static int place(double share, int parts) {
    return std::clamp(static_cast<int>(std::floor((share + 0.5) * parts)), 0, parts - 1);
  }

  PlotBox box_;
  int along_;
  int across_;
  Eigen::Vector2d length_axis_;
  Eigen::Vector2d width_axis_;
};

}  // namespace plotscan::heights
