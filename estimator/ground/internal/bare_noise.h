// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground/columns.h"

namespace plotscan::ground {

// Least noise, metres: from a lidar's range steps and the ground's own grain.
inline constexpr double kLeastNoise_m = 0.003;

// Sigma of the returns' heights about bare ground, metres: the 20th percentile, over columns of
// about the usual density, of the spread about a column's own plane. Assumes that a fifth of these
// columns is bare. Where usual columns have too few returns, blocks of columns up to 0.8 m wide are
// used instead; without enough blocks it is 3 cm. No less than kLeastNoise_m.
double bare_noise_m(const Columns& columns);

}  // namespace plotscan::ground
