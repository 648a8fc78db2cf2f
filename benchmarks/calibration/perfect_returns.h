// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "farm/farm.h"

namespace plotscan::calibration {

// What rays straight down on a grid of 2 cm hit in each plot, ground included, without any error:
// x, y and height above the terrain, metres.
std::vector<std::vector<Eigen::Vector3f>> perfect_returns(const farm::Farm& farm);

}  // namespace plotscan::calibration
