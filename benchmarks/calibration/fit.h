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

// Which returns of a sample are measured.
enum class Returns {
  thinned,  // of half of the farms all returns, of the others down to a thirtieth of them
  perfect,  // rays straight down without any error: the limit of what these features can tell
};

MeasuredField measure(const FieldSample& sample, Returns returns);

// Chooses the covariance under which the farms' ratios are most likely, and the weights of a plot's
// own features.
heights::Calibration fit(std::span<const MeasuredField> fields);

// The calibration with more farms of its crops. The kernels of these crops, and how surely crops
// are told, are fitted again; the new farms' errors are those of predictions from the farms before,
// and all else stays. Throws InputError on a farm of another crop.
heights::Calibration extended(const heights::Calibration& before,
                              std::span<const MeasuredField> fields);

// Errors of a height's predictions.
struct Errors {
  double rmse_m = 0;
  double bias_m = 0;
  double inside = 0;  // share of the truths in the 95 % interval
};

// Errors of a height over all farms of a kind, each predicted with itself, or all farms of its
// group, left out.
struct LeftOut {
  std::string name;  // of the kind
  std::string height;
  std::size_t farms = 0;
  Errors told;   // crop derived from the canopy
  Errors given;  // the crop given
};

enum class Group { farm, library, crop };

std::vector<LeftOut> leave_out(const heights::Calibration& calibration, Group group);

}  // namespace plotscan::calibration
