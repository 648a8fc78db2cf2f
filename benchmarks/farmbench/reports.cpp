// SPDX-License-Identifier: Apache-2.0
#include "farmbench/reports.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/output_file.h"
#include "farmbench/figure_text.h"
#include "farmbench/internal/change_chart.h"
#include "farmbench/internal/chosen_rows.h"
#include "farmbench/internal/failures.h"
#include "farmbench/internal/leaderboard.h"
#include "farmbench/internal/suite_page.h"
#include "farmbench/internal/sweep_table.h"

namespace plotscan::farmbench {
namespace {

// A table for terminals: the rows' methods, each on its first line only, their cases, and what
// `figures` says of them under the heads; no line for a row that it says nothing of. The columns of
// names are as wide as the longest name, so that all columns stay in line.
std::vector<std::string> lines_of(const std::vector<TableRow>& rows, std::size_t method_width,
                                  const std::string& heads,
                                  const std::function<std::string(const TableRow&)>& figures) {
  std::size_t case_width = 14;
  for (const TableRow& row : rows) {
    method_width = std::max(method_width, row.method.size());
    case_width = std::max(case_width, row.case_name.size());
  }
  const auto line = [&](const std::string& method, const std::string& case_name,
                        const std::string& rest) {
    return fmt::format("{:{}} {:{}} {}", method, method_width, case_name, case_width, rest);
  };
  std::vector<std::string> lines = {line("method", "case", heads)};
  std::string method;
  for (const TableRow& row : rows) {
    const std::string rest = figures(row);
    if (rest.empty()) continue;
    lines.push_back(line(row.method != method ? row.method : "", row.case_name, rest));
    method = row.method;
  }
  return lines;
}

std::vector<std::string> plot_lines(const std::vector<TableRow>& rows) {
  return lines_of(rows, 21,
                  fmt::format("{:>9} {:>5} {:>7} {:>9} {:>6} {:>7} {:>8}", "found  ", "extra",
                              "recall", "precision", "IoU", "centre", "heading"),
                  [](const TableRow& row) {
                    return fmt::format(
                        "{:4}/{:<4} {:5} {:>7} {:>9} {:>6} {:>7} {:>8}", row.boxes.found,
                        row.boxes.plots, row.boxes.extra, cell("{:.4f}", row.boxes.recall),
                        cell("{:.4f}", row.boxes.precision), cell("{:.3f}", row.boxes.iou_mean),
                        centimetres(row.boxes.center_rmse_m),
                        cell("{:.3f}", degrees(row.boxes.heading_rmse_rad)));
                  });
}

std::vector<std::string> rmse_lines(const SuiteResult& result, const std::vector<TableRow>& rows) {
  return lines_of(
      rows, 32, fmt::format(" {:21} {:>7} {:>6}", "RMSE", "bias", "publ."),
      [&](const TableRow& row) {
        const std::size_t without = row.height.without;
        return fmt::format(" {:21} {:>7} {:>6}", with_interval(row.height.rmse_m, row.rmse_95_m),
                           cell("{:+.2f}", 100 * row.height.bias_m), published_cm(result, row)) +
               (without > 0 ? fmt::format("  {} plots without", without) : "");
      });
}

// The errors after each farm's bias is subtracted, and whether the order of the plots is right.
std::vector<std::string> within_lines(const std::vector<TableRow>& rows) {
  return lines_of(rows, 32,
                  fmt::format("{:>7} {:>11} {:>11} {:>9} {:>10}", "RMSE", "bias a farm",
                              "within farm", "R2 within", "rho within"),
                  [](const TableRow& row) {
                    return fmt::format(
                        "{:>7} {:>11} {:>11} {:>9} {:>10}", centimetres(row.height.rmse_m),
                        centimetres(row.within.farm_bias_m), centimetres(row.within.within_m),
                        cell("{:.2f}", row.within.r2), cell("{:.2f}", row.within.rho));
                  });
}

// Those that give intervals.
std::vector<std::string> trust_lines(const std::vector<TableRow>& rows) {
  return lines_of(rows, 21,
                  fmt::format(" {:20} {:>7} {:>7} {:>8} {:>14}", "RMSE", "bias", "in 95 %",
                              "flagged", "over 5 cm, not"),
                  [](const TableRow& row) {
                    if (std::isnan(row.height.coverage95)) return std::string();
                    return fmt::format(" {:20} {:>7} {:>7} {:8} {:>14}",
                                       with_interval(row.height.rmse_m, row.rmse_95_m),
                                       cell("{:+.2f}", 100 * row.height.bias_m),
                                       percent(row.height.coverage95), row.height.flagged,
                                       unflagged(row));
                  });
}

void add_table(const std::string& title, const std::vector<std::string>& table,
               std::vector<std::string>& lines) {
  lines.insert(lines.end(), {"", title});
  lines.insert(lines.end(), table.begin(), table.end());
}

}  // namespace

std::vector<std::string> summary_lines(const SuiteResult& result,
                                       const std::vector<TableRow>& table) {
  if (result.sweep) return sweep_lines(result, table);
  std::vector<std::string> lines = plot_lines(plot_rows(result, table));
  lines.insert(lines.begin(),
               "Plots found. IoU, centre (cm rms) and heading (degrees rms) over those found");
  for (const std::string& truth : shown_truths(result, table)) {
    add_table("Truth " + truth + ". RMSE [95 % interval] and bias in cm over the plots found",
              rmse_lines(result, rows_against(truth, table)), lines);
  }
  const std::vector<TableRow> named = named_rows(table);
  const std::string against = "Against the truth each height is named after: ";
  if (!named.empty())
    add_table(against + "the farms' own biases, and the rest (cm rms)", within_lines(named), lines);
  if (const auto trust = trust_lines(named); trust.size() > 1)
    add_table(against + "truths in its 95 % intervals", trust, lines);
  add_failures(result, lines);
  if (result.published)
    lines.insert(lines.end(), {"", "publ.: RMSE of the method in " + result.published->source});
  return lines;
}

void write_reports(const std::filesystem::path& folder, const SuiteResult& result,
                   const std::vector<TableRow>& table) {
  write_whole_file(folder / "table.csv", table_csv(table));
  write_whole_file(folder / "leaderboard.md", leaderboard(result, table));
  write_suite_page(folder, result, table);
  if (result.sweep) {
    write_whole_file(folder / "sweep.csv", sweep_csv(result, table));
    write_whole_file(folder / "sweep.md", sweep_markdown(result, table));
  }
  if (!result.baseline) return;
  for (const std::string& truth : shown_truths(result, table))
    write_whole_file(folder / ("changes_" + truth + ".svg"),
                     change_chart(result, rows_against(truth, table)));
}

}  // namespace plotscan::farmbench
