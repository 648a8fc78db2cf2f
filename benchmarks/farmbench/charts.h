// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "farmbench/suite_result.h"
#include "farmbench/table.h"

namespace plotscan::farmbench {

// SVG: for each case a group of bars, one a method, RMSE in cm with its interval; a dashed line
// where the case has a published figure. `rows` are of one truth.
std::string rmse_chart(const SuiteResult& result, const std::vector<TableRow>& rows);

// SVG: every found plot of a case, estimated against true height, by the methods beside which
// figures were published (else the suite's first) and by the last method of the suite.
std::string height_chart(const SuiteResult& result, const std::string& case_name,
                         const std::string& truth);

// SVG: for each case but the baseline how much it changes each method's RMSE, in cm, with its
// interval. `rows` are of one truth; the result names a baseline.
std::string change_chart(const SuiteResult& result, const std::vector<TableRow>& rows);

}  // namespace plotscan::farmbench
