// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "heights/calibration.h"

namespace plotscan::calibration {

// Fits the weights of the compared features (one row per farm, scaled) and the covariance under
// which the values (one row per farm) are most likely, all values together, each with its own best
// scale (Rasmussen and Williams 2006, equation 5.8). `noise`: how many times noisier than usual a
// farm's values are. The weights' logarithms have a normal prior with a spread of 1 about their
// mean, so uninformative features get little weight.
heights::Kernel fit_kernel(const Eigen::MatrixXd& compared, const Eigen::MatrixXd& values,
                           const std::vector<double>& noise);

}  // namespace plotscan::calibration
