// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calibration/farm_groups.h"
#include "heights/calibration.h"

namespace plotscan::calibration {

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
  Errors recognised;  // the crop recognised from the canopy
  Errors given;       // the crop given
};

std::vector<LeftOut> leave_out(const heights::Calibration& calibration, Group group);

}  // namespace plotscan::calibration
