// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "heights/calibration.h"

namespace plotscan::calibration {

// The features' weights and the covariance under which the farms' ratios are most likely, all
// heights together, each with a scale of its own that is the best for it (Rasmussen and Williams
// 2006, equation 5.8). The weights' logarithms are taken to be normal, with a spread of 1 about
// their mean: features that tell little are left little weight.
void fit_covariance(heights::Calibration& calibration);

}  // namespace plotscan::calibration
