// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "farm/farm.h"

namespace plotscan::calibration {

// What rays straight down see of a plot without noise, ground included.
struct CanopyTruth {
  // "canopy_p95" and "canopy_p99" of the height above the terrain, of rays on a grid of 1 cm.
  std::map<std::string, double> heights_m = {};
  // Every second ray of every second row: x, y and height above the terrain, metres.
  std::vector<Eigen::Vector3f> points = {};
};

std::vector<CanopyTruth> canopy_truths(const farm::Farm& farm);

}  // namespace plotscan::calibration
