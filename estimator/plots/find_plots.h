// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Core>

#include "plots/hints.h"
#include "plots/plot_field.h"

namespace plotscan::plots {

// Finds the plots of a field from its points as (x, y, height above the ground), metres. noise_m is
// the sigma of the heights.
PlotField find_plots(std::span<const Eigen::Vector3f> points, double noise_m, const Hints& hints,
                     int threads);

}  // namespace plotscan::plots
