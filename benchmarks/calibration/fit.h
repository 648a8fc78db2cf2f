// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "calibration/field_sample.h"
#include <Eigen/Core>

#include "heights/calibration.h"

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

MeasuredField measure(const FieldSample& sample);

// Chooses the covariances that predict each library's farms best from the other libraries', and
// the weights of a plot's own features.
heights::Calibration fit(std::span<const MeasuredField> fields);

// How well each height is predicted where a farm, or all farms of its library, are left out.
struct LeftOut {
  std::string library;
  std::string height;
  std::size_t farms = 0;
  double rmse = 0;    // of the ratio to the top
  double bias = 0;    // the same
  double inside = 0;  // share of the truths in the 95 % interval
};

std::vector<LeftOut> leave_library_out(const heights::Calibration& calibration);

}  // namespace plotscan::calibration
