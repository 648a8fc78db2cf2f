// SPDX-License-Identifier: Apache-2.0
#include "cloud/surroundings.h"

#include <algorithm>
#include <limits>

namespace plotscan::cloud {

Area surroundings(const std::vector<PlotBox>& boxes, double extend_m) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Area area{kFar, kFar, -kFar, -kFar};
  for (PlotBox box : boxes) {
    box.length_m += 2 * extend_m;
    for (const Eigen::Vector2d& corner : box.corners()) {
      area = {std::min(area[0], corner.x()), std::min(area[1], corner.y()),
              std::max(area[2], corner.x()), std::max(area[3], corner.y())};
    }
  }
  return area;
}

}  // namespace plotscan::cloud
