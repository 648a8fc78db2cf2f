// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace plotscan::plots {

// The median of those steps from plot to plot that are no alleys: up to 1.3 times the lower
// quartile. 0 where there are none.
double usual_step(std::vector<double> steps);

// Adds places at equal steps between others, where a step is a whole multiple of the usual one.
void fill_in(std::vector<double>& places);

// Where the parabola through three values has its top, in steps from the middle one; 0 where it has
// none.
double parabola_top(double before, double middle, double after);

}  // namespace plotscan::plots
