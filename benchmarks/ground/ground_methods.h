// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::ground_error {

// A method's ground under one plot; frame of the points, metres.
struct PlotGround {
  std::function<double(const Eigen::Vector2d&)> height;  // NaN where the method has none
  double standard_error_m = 0;                           // of the mean over the plot; 0: not given
};

struct Method {
  std::string name;
  std::function<std::vector<PlotGround>(std::span<const Eigen::Vector3f>,
                                        const std::vector<PlotBox>&)>
      ground;
};

// RANSAC's plane for each plot (Dhami et al., 2020), PCL's progressive morphological filter (Zhang
// et al., 2003), and ground::fit_surface.
std::vector<Method> methods(int threads);

}  // namespace plotscan::ground_error
