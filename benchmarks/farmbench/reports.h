// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "farmbench/suite_result.h"
#include "farmbench/table.h"

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

// The truths that the reports show, of those in the table: the suite's, else the tallest and the
// mean plant.
std::vector<std::string> shown_truths(const SuiteResult& result,
                                      const std::vector<TableRow>& table);

// One row for each of the suite's methods and cases, whose columns of boxes count; named after the
// method. All of a method's heights share its plots.
std::vector<TableRow> plot_rows(const SuiteResult& result, const std::vector<TableRow>& table);

}  // namespace plotscan::farmbench
