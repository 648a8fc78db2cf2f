// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace plotscan {

// The share-quantile (0..1) of the values, linear between order statistics (Hyndman and Fan's type
// 7, NumPy's and R's default). NaN when there are none.
double quantile(std::vector<double> values, double share);

// NaN when there are none.
double mean(const std::vector<double>& values);

}  // namespace plotscan
