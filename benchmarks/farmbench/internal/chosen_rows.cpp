// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/chosen_rows.h"

#include <algorithm>
#include <iterator>

#include <fmt/core.h>

#include "core/contains.h"
#include "farmbench/internal/method_rows.h"

namespace plotscan::farmbench {
namespace {

// The rows that `is_wanted` holds for, by method in the table's order, then by case.
template <class IsWanted>
std::vector<TableRow> by_method(const std::vector<TableRow>& table, const IsWanted& is_wanted) {
  std::vector<TableRow> rows;
  for (const std::string& method : methods_of(table)) {
    std::ranges::copy_if(table, std::back_inserter(rows), [&](const TableRow& row) {
      return row.method == method && is_wanted(row);
    });
  }
  return rows;
}

}  // namespace

std::vector<TableRow> rows_against(const std::string& truth, const std::vector<TableRow>& table) {
  return by_method(table, [&](const TableRow& row) { return row.truth == truth && row.shown; });
}

std::vector<TableRow> named_rows(const std::vector<TableRow>& table) {
  return by_method(table, [](const TableRow& row) { return row.named; });
}

std::vector<TableRow> plot_rows(const SuiteResult& result, const std::vector<TableRow>& table) {
  std::vector<TableRow> rows;
  for (const std::string& name : result.methods) {
    const std::string height = heights_of(result, name).front().row;
    for (const CaseInfo& info : result.cases) {
      const auto row = std::ranges::find_if(table, [&](const TableRow& candidate) {
        return candidate.method == height && candidate.case_name == info.name;
      });
      if (row == table.end()) continue;
      rows.push_back(*row);
      rows.back().method = name;
    }
  }
  return rows;
}

std::vector<std::string> shown_truths(const SuiteResult& result,
                                      const std::vector<TableRow>& table) {
  std::vector<std::string> shown = result.truths;
  if (shown.empty()) shown = {"height_max_m", "height_mean_m"};
  std::erase_if(
      shown, [&](const std::string& truth) { return !contains(table, truth, &TableRow::truth); });
  return shown;
}

std::string published_cm(const SuiteResult& result, const TableRow& row) {
  if (!result.published || !contains(result.published->methods, row.method)) return "";
  const auto info = std::ranges::find(result.cases, row.case_name, &CaseInfo::name);
  if (info == result.cases.end() || !info->published_rmse_cm) return "";
  return fmt::format("{:.1f}", *info->published_rmse_cm);
}

}  // namespace plotscan::farmbench
