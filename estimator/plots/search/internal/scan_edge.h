// SPDX-License-Identifier: Apache-2.0
#pragma once

// Where a survey ends.

#include <functional>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::plots {

// Whether the scanned area ends at one of a plot's sides.
bool is_cut_off(const PlotBox& plot,
                const std::function<bool(const Eigen::Vector2d& place)>& is_scanned);

}  // namespace plotscan::plots
