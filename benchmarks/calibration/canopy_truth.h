// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "farm/farm.h"

namespace plotscan::calibration {

// Of each plot, "canopy_p95" and "canopy_p99": percentiles of the height above the terrain of what
// rays straight down on a grid of 1 cm over its box hit, ground included, metres.
std::vector<std::map<std::string, double>> canopy_truths(const farm::Farm& farm);

}  // namespace plotscan::calibration
