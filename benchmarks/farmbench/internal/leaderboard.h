// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "farmbench/results_table.h"
#include "farmbench/suite_result.h"

namespace plotscan::farmbench {

// leaderboard.md: plots found, heights named after truths; for each truth and case, the methods by
// RMSE.
std::string leaderboard(const SuiteResult& result, const std::vector<TableRow>& table);

}  // namespace plotscan::farmbench
