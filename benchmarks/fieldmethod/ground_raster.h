// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace plotscan::fieldmethod {

// Heights of the ground from the points that a filter takes for it: their mean in square cells; a
// cell without any takes the mean of its neighbours, cell after cell inwards. Frame of the points,
// metres.
class GroundRaster {
 public:
  // The cells cover the points. Throws InputError where there are none.
  GroundRaster(const pcl::PointCloud<pcl::PointXYZ>& ground, double cell_m);

  // Bilinear between the cells' centres; beyond the outermost ones, as at the nearest.
  double z_m(double x, double y) const;

 private:
  std::size_t column(double x) const { return static_cast<std::size_t>((x - low_x_) / cell_m_); }
  std::size_t row(double y) const { return static_cast<std::size_t>((y - low_y_) / cell_m_); }
  double at(std::size_t r, std::size_t c) const { return z_m_[r * columns_ + c]; }
  // Fills the empty cells that have a neighbour; whether there were any.
  bool fill_rim();

  double cell_m_;
  double low_x_ = 0;
  double low_y_ = 0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<double> z_m_;
};

}  // namespace plotscan::fieldmethod
