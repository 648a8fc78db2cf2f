// SPDX-License-Identifier: Apache-2.0
#include "methods/given_boxes.h"

#include <algorithm>
#include <limits>

namespace plotscan::methods {

std::vector<estimate::PlotEstimate> given_plots(const std::vector<PlotBox>& boxes,
                                                const Eigen::Vector3d& origin) {
  std::vector<estimate::PlotEstimate> plots;
  for (const PlotBox& box : boxes) {
    plots.push_back({.id = static_cast<std::uint32_t>(plots.size() + 1), .box = box});
    plots.back().box.center -= origin.head<2>();
  }
  return plots;
}

cloud::Area surroundings(const std::vector<PlotBox>& boxes, double extend_m) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  cloud::Area area{kFar, kFar, -kFar, -kFar};
  for (PlotBox box : boxes) {
    box.length_m += 2 * extend_m;
    for (const Eigen::Vector2d& corner : box.corners()) {
      area = {std::min(area[0], corner.x()), std::min(area[1], corner.y()),
              std::max(area[2], corner.x()), std::max(area[3], corner.y())};
    }
  }
  return area;
}

}  // namespace plotscan::methods
