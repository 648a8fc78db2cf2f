// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "farmbench/results_table.h"
#include "farmbench/suite_result.h"

// The rows of a suite's table that its reports show together.
namespace plotscan::farmbench {

// The rows that are compared with one truth, by method in the table's order, then by case.
std::vector<TableRow> rows_against(const std::string& truth, const std::vector<TableRow>& table);

// The rows whose height is named after the truth, in the same order.
std::vector<TableRow> named_rows(const std::vector<TableRow>& table);

// One row for each of the suite's methods and cases, whose columns of boxes count; named after the
// method. All of a method's heights share its plots.
std::vector<TableRow> plot_rows(const SuiteResult& result, const std::vector<TableRow>& table);

// The truths that the reports show, of those in the table: the suite's, else the tallest and the
// mean plant.
std::vector<std::string> shown_truths(const SuiteResult& result,
                                      const std::vector<TableRow>& table);

// The published RMSE, cm, that belongs beside the row; "" where there is none.
std::string published_cm(const SuiteResult& result, const TableRow& row);

}  // namespace plotscan::farmbench
