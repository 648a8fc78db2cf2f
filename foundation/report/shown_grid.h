// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "report/shown_field.h"

namespace plotscan::report {

// A fitted ground, moved by `move_m` (metres) into the frame of the page's cloud. A template, since
// this folder does not depend on ground::Surface.
template <class Surface>
ShownGrid shown_grid(const Surface& surface, const Eigen::Vector3d& move_m) {
  ShownGrid grid{.first = surface.origin + move_m.template head<2>(),
                 .cell_m = surface.cell_m,
                 .columns = surface.columns,
                 .rows = surface.rows,
                 .z_m = surface.z_m,
                 .standard_error_m = surface.sd_m};
  for (float& z_m : grid.z_m) z_m += static_cast<float>(move_m.z());
  return grid;
}

}  // namespace plotscan::report
