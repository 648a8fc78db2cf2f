// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "heights/calibration.h"

namespace plotscan::calibration {

// The weights of what is compared of the farms (a row a farm, scaled), and the covariance, under
// which their values (a row a farm) are most likely, all values together, each with a scale of its
// own that is the best for it (Rasmussen and Williams 2006, equation 5.8). `noise`: how much
// noisier than usual a farm's values are. The weights' logarithms are taken to be normal, with a
// spread of 1 about their mean: what tells little is left little weight.
heights::Kernel fit_kernel(const Eigen::MatrixXd& compared, const Eigen::MatrixXd& values,
                           const std::vector<double>& noise);

}  // namespace plotscan::calibration
