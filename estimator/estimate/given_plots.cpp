// SPDX-License-Identifier: Apache-2.0
#include "estimate/given_plots.h"

namespace plotscan::estimate {

std::vector<PlotEstimate> given_plots(const std::vector<PlotBox>& boxes,
                                      const Eigen::Vector3d& origin) {
  std::vector<PlotEstimate> plots;
  for (const PlotBox& box : boxes) {
    plots.push_back({.id = static_cast<std::uint32_t>(plots.size() + 1), .box = box});
    plots.back().box.center -= origin.head<2>();
  }
  return plots;
}

}  // namespace plotscan::estimate
