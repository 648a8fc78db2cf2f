// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calibration/field_sample.h"

namespace plotscan::calibration {

// A plot as the calibration takes it.
struct MeasuredPlot {
  double top_m = 0;
  Eigen::VectorXd features;
  std::map<std::string, double> truth;
};

struct MeasuredField {
  std::string library;
  std::vector<MeasuredPlot> plots;
};

// Which returns of a sample are measured.
enum class Returns {
  thinned,  // of half of the farms all returns, of the others down to a thirtieth of them
  perfect,  // rays straight down without any error: the limit of what these features can tell
};

// The plots of a sample whose canopy can be measured.
MeasuredField measure(const FieldSample& sample, Returns returns);

// The plot's heights, in this order, over its canopy's top.
Eigen::VectorXd ratios_of(const MeasuredPlot& plot, const std::vector<std::string>& heights);

}  // namespace plotscan::calibration
