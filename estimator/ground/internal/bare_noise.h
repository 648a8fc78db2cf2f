// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground/columns.h"

namespace plotscan::ground {

// What a lidar's steps of range leave of noise, and the ground's own grain, metres.
inline constexpr double kLeastNoise_m = 0.003;

// Sigma of the returns' heights about bare ground, metres: the 20th percentile, over columns about
// as dense as usual, of the spread about a column's own plane. It assumes that a fifth of these is
// bare. Where usual columns have too few returns, blocks of columns up to 0.8 m wide stand for
// them; without enough of these it is 3 cm. No less than kLeastNoise_m.
double bare_noise_m(const Columns& columns);

}  // namespace plotscan::ground
