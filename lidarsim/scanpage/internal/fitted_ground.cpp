// SPDX-License-Identifier: Apache-2.0
#include "scanpage/internal/fitted_ground.h"

#include "core/error.h"
#include "ground/surface.h"
#include "report/shown_grid.h"

namespace plotscan::scanpage {

std::optional<report::ShownGrid> fitted_ground(const report::ShownCloud& cloud, int threads) {
  std::vector<Eigen::Vector3f> places;
  places.reserve(cloud.points.size());
  for (const report::ShownPoint& point : cloud.points) places.push_back(point.place);
  try {
    return report::shown_grid(ground::fit_surface(places, {.threads = threads}), cloud.origin);
  } catch (const InputError&) {
    return std::nullopt;  // such as a too large field: the page then shows the cloud's own heights
  }
}

}  // namespace plotscan::scanpage
