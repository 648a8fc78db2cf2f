// SPDX-License-Identifier: Apache-2.0
#include "farmbench/reports.h"

#include <algorithm>
#include <cmath>

#include "farmbench/charts.h"
#include "farmbench/format.h"
#include "farmbench/html_report.h"
#include "farmbench/text_file.h"

namespace plotscan::farmbench {
namespace {

std::string leaderboard_line(std::size_t rank, const TableRow& row, const std::string& published) {
  std::string line;
  for (const std::string& cell :
       {std::to_string(rank), row.method,
        with_interval(row.rmse_m, row.rmse_low_m, row.rmse_high_m), published,
        number("%+.2f", 100 * row.bias_m), centimetres(row.mae_m), number("%.3f", row.r2),
        formatted("%zu of %zu", row.found, row.plots), std::to_string(row.extra),
        number("%.3f", row.iou_median), number("%.2f", row.seconds)}) {
    line += "| " + cell + " ";
  }
  return line + "|";
}

// A row a case, a column a method: RMSE, and how much that is more than the baseline's.
std::string changes_by_case(const SuiteResult& result, const std::vector<TableRow>& rows) {
  std::string head = "| case |";
  std::string rule = "\n| --- |";
  std::vector<std::string> methods;
  for (const TableRow& row : rows) {
    if (std::ranges::count(methods, row.method) > 0) continue;
    methods.push_back(row.method);
    head += " " + row.method + " |";
    rule += " --- |";
  }
  std::string text = head + rule + "\n";
  for (const CaseInfo& info : result.cases) {
    text += "| " + info.name + " |";
    for (const std::string& method : methods) {
      const auto row = std::ranges::find_if(rows, [&](const TableRow& candidate) {
        return candidate.method == method && candidate.case_name == info.name;
      });
      if (row == rows.end()) continue;
      text += " " + centimetres(row->rmse_m);
      if (info.name != *result.baseline)
        text += " (" + number("%+.2f", 100 * row->rmse_change_m) + ")";
      text += " |";
    }
    text += "\n";
  }
  return text;
}

// For each truth and case, the methods by RMSE.
std::string leaderboard(const SuiteResult& result, const std::vector<TableRow>& table) {
  std::string text = "# Suite " + result.suite +
                     "\n\nRMSE, bias and MAE in cm over the plots found; 95 % bootstrap intervals "
                     "over farms. All columns and truths are in table.csv.\n";
  for (const std::string& truth : shown_truths(table)) {
    if (!result.baseline) break;
    text += "\n## RMSE in cm (and its change against " + *result.baseline + "), truth " + truth +
            "\n\n" + changes_by_case(result, rows_by_method(table, truth));
  }
  for (const std::string& truth : shown_truths(table)) {
    for (const CaseInfo& info : result.cases) {
      std::vector<TableRow> rows;
      std::ranges::copy_if(table, std::back_inserter(rows), [&](const TableRow& row) {
        return row.truth == truth && row.case_name == info.name;
      });
      // NaN, a method without any height, comes last.
      std::ranges::stable_sort(rows, [](const TableRow& a, const TableRow& b) {
        return a.rmse_m < b.rmse_m || (std::isnan(b.rmse_m) && !std::isnan(a.rmse_m));
      });
      text += "\n## " + info.name + ", truth " + truth +
              "\n\n| | method | RMSE [95 %] | published | bias | MAE | R2 | found | extra | IoU "
              "median | seconds |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | "
              "--- |\n";
      for (std::size_t i = 0; i < rows.size(); ++i)
        text += leaderboard_line(i + 1, rows[i], published_cm(result, rows[i])) + "\n";
    }
  }
  return text;
}

std::string summary_line(const SuiteResult& result, const TableRow& row, bool first_of_method) {
  return formatted("%-30s %-9s %4zu/%-4zu %5zu %5s  %-21s %7s %6s",
                   first_of_method ? row.method.c_str() : "", row.case_name.c_str(), row.found,
                   row.plots, row.extra, number("%.2f", row.iou_median).c_str(),
                   with_interval(row.rmse_m, row.rmse_low_m, row.rmse_high_m).c_str(),
                   number("%+.2f", 100 * row.bias_m).c_str(), published_cm(result, row).c_str());
}

}  // namespace

std::vector<std::string> shown_truths(const std::vector<TableRow>& table) {
  std::vector<std::string> shown;
  for (const char* truth : {"height_max_m", "height_mean_m"}) {
    if (std::ranges::find(table, truth, &TableRow::truth) != table.end()) shown.emplace_back(truth);
  }
  return shown;
}

std::vector<TableRow> rows_by_method(const std::vector<TableRow>& table, const std::string& truth) {
  std::vector<std::string> methods;
  for (const TableRow& row : table) {
    if (std::ranges::find(methods, row.method) == methods.end()) methods.push_back(row.method);
  }
  std::vector<TableRow> rows;
  for (const std::string& method : methods) {
    std::ranges::copy_if(table, std::back_inserter(rows), [&](const TableRow& row) {
      return row.method == method && row.truth == truth;
    });
  }
  return rows;
}

std::string published_cm(const SuiteResult& result, const TableRow& row) {
  if (!result.published || std::ranges::count(result.published->methods, row.method) == 0)
    return "";
  const auto info = std::ranges::find(result.cases, row.case_name, &CaseInfo::name);
  if (info == result.cases.end() || !info->published_rmse_cm) return "";
  return formatted("%.1f", *info->published_rmse_cm);
}

std::vector<std::string> summary_lines(const SuiteResult& result,
                                       const std::vector<TableRow>& table) {
  std::vector<std::string> lines;
  for (const std::string& truth : shown_truths(table)) {
    if (!lines.empty()) lines.emplace_back("");
    lines.push_back("Truth " + truth +
                    ". RMSE [95 % interval] and bias in cm over the plots found");
    lines.push_back(formatted("%-30s %-9s %9s %5s %5s  %-21s %7s %6s", "method", "case", "found  ",
                              "extra", "IoU", "RMSE", "bias", "publ."));
    std::string method;
    for (const TableRow& row : rows_by_method(table, truth)) {
      lines.push_back(summary_line(result, row, row.method != method));
      method = row.method;
    }
  }
  if (result.published) {
    lines.emplace_back("");
    lines.push_back("publ.: RMSE of the method in " + result.published->source);
  }
  return lines;
}

void write_reports(const std::filesystem::path& folder, const SuiteResult& result,
                   const std::vector<TableRow>& table) {
  write_text(folder / "table.csv", table_csv(table));
  write_text(folder / "leaderboard.md", leaderboard(result, table));
  write_text(folder / "report.html", html_report(result, table));
  if (!result.baseline) return;
  for (const std::string& truth : shown_truths(table))
    write_text(folder / ("changes_" + truth + ".svg"),
               change_chart(result, rows_by_method(table, truth)));
}

}  // namespace plotscan::farmbench
