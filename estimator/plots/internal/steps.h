// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library.

#include <vector>

namespace plotscan::plots {

// The median of those steps from plot to plot that are no alleys: up to 1.3 times the lower
// quartile. 0 where there are none.
double usual_step(std::vector<double> steps);

}  // namespace plotscan::plots
