// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <Eigen/Core>

namespace plotscan::plots {

// Standard error of the ground's height at a place, metres; NaN where there is no ground. Called by
// several threads at once.
using GroundError = std::function<double(const Eigen::Vector2d&)>;

}  // namespace plotscan::plots
