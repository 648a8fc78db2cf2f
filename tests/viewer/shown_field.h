// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include <fmt/core.h>

#include "estimate/estimate.h"
#include "temporary_folder.h"

namespace plotscan::view {

// The ground as a plane through (origin, z_m), all seen, with a standard error of 1 cm.
inline ground::Surface plane(const Eigen::Vector2d& origin, double z_m,
                             const Eigen::Vector2d& slope, int nodes) {
  ground::Surface surface{{.origin = origin, .cell_m = 0.2, .columns = nodes, .rows = nodes}};
  for (int row = 0; row < nodes; ++row) {
    for (int column = 0; column < nodes; ++column) {
      const Eigen::Vector2d place = surface.cell_m * Eigen::Vector2d(column, row);
      surface.z_m.push_back(static_cast<float>(z_m + slope.dot(place)));
      surface.sd_m.push_back(0.01F);
      surface.seen.push_back(1);
    }
  }
  return surface;
}

// A PLY with doubles of a field from `low` to `high` at a step: z is the function's.
inline std::filesystem::path write_field(const testing::TemporaryFolder& folder,
                                         const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                                         double step_m,
                                         const std::function<double(const Eigen::Vector2d&)>& z) {
  std::string points;
  int count = 0;
  for (double x = low.x(); x <= high.x(); x += step_m) {
    for (double y = low.y(); y <= high.y(); y += step_m, ++count)
      points += fmt::format("{:.4f} {:.4f} {:.4f}\n", x, y, z({x, y}));
  }
  return folder.write("cloud.ply", "ply\nformat ascii 1.0\nelement vertex " +
                                       std::to_string(count) +
                                       "\nproperty double x\nproperty double y\n"
                                       "property double z\nend_header\n" +
                                       points);
}

}  // namespace plotscan::view
