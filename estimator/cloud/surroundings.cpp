// SPDX-License-Identifier: Apache-2.0
#include "cloud/surroundings.h"

#include "core/extent.h"

namespace plotscan::cloud {

Area surroundings(std::vector<PlotBox> boxes, double extend_m) {
  for (PlotBox& box : boxes) box.length_m += 2 * extend_m;
  const Eigen::AlignedBox2d extent = extent_of(boxes);
  return {extent.min().x(), extent.min().y(), extent.max().x(), extent.max().y()};
}

}  // namespace plotscan::cloud
