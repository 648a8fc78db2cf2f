// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "farmbench/suite_result.h"
#include "farmbench/table.h"

namespace plotscan::farmbench {

// One self-contained page: the table, a bar chart of RMSE by case and method, and for each case the
// estimated against the true heights.
std::string html_report(const SuiteResult& result, const std::vector<TableRow>& table);

}  // namespace plotscan::farmbench
