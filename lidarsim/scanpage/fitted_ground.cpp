// SPDX-License-Identifier: Apache-2.0
#include "scanpage/fitted_ground.h"

#include "core/error.h"

namespace plotscan::scanpage {

report::ShownGrid shown_grid(const ground::Surface& surface, const Eigen::Vector3d& move_m) {
  report::ShownGrid grid{.first = surface.origin + move_m.head<2>(),
                         .cell_m = surface.cell_m,
                         .columns = surface.columns,
                         .rows = surface.rows,
                         .z_m = surface.z_m,
                         .standard_error_m = surface.sd_m,
                         .seen = {surface.seen.begin(), surface.seen.end()}};
  for (float& z_m : grid.z_m) z_m += static_cast<float>(move_m.z());
  return grid;
}

std::optional<report::ShownGrid> fitted_ground(const report::ShownCloud& cloud, int threads) {
  std::vector<Eigen::Vector3f> places;
  places.reserve(cloud.points.size());
  for (const report::ShownPoint& point : cloud.points) places.push_back(point.place);
  try {
    return shown_grid(ground::fit_surface(places, {.threads = threads}), cloud.origin);
  } catch (const InputError&) {
    return std::nullopt;  // too large a field, say: the page shows heights of the cloud's own
  }
}

}  // namespace plotscan::scanpage
