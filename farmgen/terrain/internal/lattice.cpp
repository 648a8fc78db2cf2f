// SPDX-License-Identifier: Apache-2.0
#include "terrain/internal/lattice.h"

#include <cmath>

namespace plotscan::terrain {

Lattice lattice_over(const Eigen::AlignedBox2d& box, const LatticeLayout& layout) {
  const Eigen::Vector2d along(std::cos(layout.heading_rad), std::sin(layout.heading_rad));
  const Eigen::Vector2d across(-along.y(), along.x());
  Eigen::AlignedBox2d steps;  // the box in steps along and across the rows
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d corner = box.corner(static_cast<Eigen::AlignedBox2d::CornerType>(i));
    steps.extend(Eigen::Vector2d(corner.dot(along) / layout.column_step_m,
                                 (corner.dot(across) - layout.offset_m) / layout.row_step_m));
  }
  const Eigen::Vector2d first = steps.min().array().floor();
  const Eigen::Vector2d last = steps.max().array().ceil();
  return {.origin = first.x() * layout.column_step_m * along +
                    (first.y() * layout.row_step_m + layout.offset_m) * across,
          .along = layout.column_step_m * along,
          .across = layout.row_step_m * across,
          .rows = static_cast<Eigen::Index>(last.y() - first.y()) + 1,
          .columns = static_cast<Eigen::Index>(last.x() - first.x()) + 1};
}

}  // namespace plotscan::terrain
