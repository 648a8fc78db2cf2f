// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: small robust statistics.

#include <vector>

namespace plotscan::plots {

// The upper one of the two in the middle; 0 of none.
double median(std::vector<double> values);

// The usual distance of neighbours: the median of those that are not much longer than the shorter
// ones, as those across a missing plot or an alley are. 0 of none.
double usual_step(std::vector<double> steps);

}  // namespace plotscan::plots
