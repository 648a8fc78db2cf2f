// SPDX-License-Identifier: Apache-2.0
#include "fieldmethod/ground_raster.h"

#include <algorithm>
#include <cmath>

#include <pcl/common/common.h>

#include "core/error.h"
#include "core/statistics.h"

namespace plotscan::fieldmethod {

GroundRaster::GroundRaster(const pcl::PointCloud<pcl::PointXYZ>& ground, double cell_m)
    : cell_m_(cell_m) {
  if (ground.empty()) throw InputError("no ground was found");
  pcl::PointXYZ low, high;
  pcl::getMinMax3D(ground, low, high);
  low_x_ = static_cast<double>(low.x);
  low_y_ = static_cast<double>(low.y);
  columns_ = column(high.x) + 1;
  rows_ = row(high.y) + 1;
  std::vector<double> sums(columns_ * rows_, 0);
  std::vector<int> counts(columns_ * rows_, 0);
  for (const pcl::PointXYZ& point : ground) {
    const std::size_t cell = row(point.y) * columns_ + column(point.x);
    sums[cell] += static_cast<double>(point.z);
    ++counts[cell];
  }
  z_m_.assign(sums.size(), kNaN);
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (counts[i] > 0) z_m_[i] = sums[i] / counts[i];
  while (fill_rim()) {
  }
}

double GroundRaster::z_m(double x, double y) const {
  const double u = std::clamp((x - low_x_) / cell_m_ - 0.5, 0.0, static_cast<double>(columns_ - 1));
  const double v = std::clamp((y - low_y_) / cell_m_ - 0.5, 0.0, static_cast<double>(rows_ - 1));
  const auto c =
      std::min(static_cast<std::size_t>(u), columns_ - std::min<std::size_t>(2, columns_));
  const auto r = std::min(static_cast<std::size_t>(v), rows_ - std::min<std::size_t>(2, rows_));
  const std::size_t next_c = std::min(c + 1, columns_ - 1);
  const std::size_t next_r = std::min(r + 1, rows_ - 1);
  const double s = u - static_cast<double>(c);
  const double t = v - static_cast<double>(r);
  return (1 - t) * ((1 - s) * at(r, c) + s * at(r, next_c)) +
         t * ((1 - s) * at(next_r, c) + s * at(next_r, next_c));
}

bool GroundRaster::fill_rim() {
  const std::vector<double> before = z_m_;
  bool changed = false;
  for (std::size_t cell = 0; cell < before.size(); ++cell) {
    if (!std::isnan(before[cell])) continue;
    std::vector<double> around;
    const std::size_t r = cell / columns_;
    const std::size_t c = cell % columns_;
    if (r > 0) around.push_back(before[cell - columns_]);
    if (r + 1 < rows_) around.push_back(before[cell + columns_]);
    if (c > 0) around.push_back(before[cell - 1]);
    if (c + 1 < columns_) around.push_back(before[cell + 1]);
    std::erase_if(around, [](double z) { return std::isnan(z); });
    if (around.empty()) continue;
    z_m_[cell] = mean(around);
    changed = true;
  }
  return changed;
}

}  // namespace plotscan::fieldmethod
