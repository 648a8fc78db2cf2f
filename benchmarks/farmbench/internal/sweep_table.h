// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "farmbench/results_table.h"
#include "farmbench/suite_result.h"

namespace plotscan::farmbench {

// What one combination's flights cost, means over the farms that were flown; NaN where none was.
struct FlightCost {
  double flight_s = 0;
  double points = 0;  // of the scan
};

// The cost of each case of the result, in their order.
std::vector<FlightCost> flight_costs(const SuiteResult& result);

// The functions below take the result of a sweep and its table.

// The name of the rows of the height that the sweep asks about.
std::string asked_row(const SuiteResult& result);

// The rows of the height and truth that the sweep asks about, one for each combination.
std::vector<TableRow> sweep_rows(const SuiteResult& result, const std::vector<TableRow>& table);

// The shortest flight that reaches the sweep's goal, by its place in sweep_rows; none where no
// flight does, or where there is no goal.
std::optional<std::size_t> flight_needed(const SuiteResult& result,
                                         const std::vector<TableRow>& rows);

// sweep.csv: a column for each axis, then
// method,truth,farms,plots,found,missed,extra,recall,rmse_cm,
// rmse_lo_cm,rmse_hi_cm,bias_cm,within_cm,flight_s,points; a row for each combination and each
// height, against the truth it is named after and the one that the sweep asks about.
std::string sweep_csv(const SuiteResult& result, const std::vector<TableRow>& table);

// sweep.md: the answer and the rows of sweep_rows.
std::string sweep_markdown(const SuiteResult& result, const std::vector<TableRow>& table);

// The same for a terminal.
std::vector<std::string> sweep_lines(const SuiteResult& result, const std::vector<TableRow>& table);

}  // namespace plotscan::farmbench
