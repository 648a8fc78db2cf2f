// SPDX-License-Identifier: Apache-2.0
#include "estimate/given_plots.h"

#include "core/error.h"

namespace plotscan::estimate {

std::vector<PlotEstimate> given_plots(const std::vector<PlotBox>& boxes,
                                      const Eigen::Vector3d& origin,
                                      const std::vector<int>& trials) {
  check(trials.empty() || trials.size() == boxes.size(), "trials of other boxes");
  std::vector<PlotEstimate> plots;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    plots.push_back({.id = static_cast<std::uint32_t>(i + 1),
                     .trial = trials.empty() ? 0 : trials[i],
                     .box = boxes[i]});
    plots.back().box.center -= origin.head<2>();
  }
  return plots;
}

}  // namespace plotscan::estimate
