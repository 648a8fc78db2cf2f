// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "farmbench/results_table.h"
#include "farmbench/suite_result.h"

namespace plotscan::farmbench {

// Writes table.csv, leaderboard.md and report.html into the results folder; of a sweep sweep.csv
// and sweep.md, too.
void write_reports(const std::filesystem::path& folder, const SuiteResult& result,
                   const std::vector<TableRow>& table);

// The table for people, in at most 100 columns unless names are long: method by case, for the
// tallest plant (the paper's pattern) and the mean plant, beside the published figures; of a sweep,
// its flights.
std::vector<std::string> summary_lines(const SuiteResult& result,
                                       const std::vector<TableRow>& table);

}  // namespace plotscan::farmbench
