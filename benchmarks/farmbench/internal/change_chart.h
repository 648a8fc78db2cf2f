// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "farmbench/results_table.h"
#include "farmbench/suite_result.h"

namespace plotscan::farmbench {

// SVG: for each case but the baseline how much it changes each method's RMSE, in cm, with its
// interval. `rows` are of one truth; the result names a baseline.
std::string change_chart(const SuiteResult& result, const std::vector<TableRow>& rows);

}  // namespace plotscan::farmbench
