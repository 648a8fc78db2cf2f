// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/leaderboard.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/list_of.h"
#include "farmbench/figure_text.h"
#include "farmbench/internal/chosen_rows.h"
#include "farmbench/internal/failures.h"
#include "farmbench/markdown.h"

namespace plotscan::farmbench {
namespace {

// "30 of 30, 2 without": plots found, of these the ones without this height.
std::string found_of(const TableRow& row) {
  const std::string without =
      row.height.without > 0 ? fmt::format(", {} without", row.height.without) : "";
  return fmt::format("{} of {}", row.boxes.found, row.boxes.plots) + without;
}

// Whether a row has a place among others: RMSE is that of the plots that a method has measured, and
// one that leaves the harder ones out, or boxes out of the air in, is no better for it.
bool has_place(const TableRow& row) {
  constexpr double kMost = 0.95;
  const auto measured = static_cast<double>(row.boxes.found - row.height.without);
  return measured >= kMost * static_cast<double>(row.boxes.plots) && !(row.boxes.precision < kMost);
}

// A row without a place has rank 0.
Cells leaderboard_cells(std::size_t rank, const TableRow& row, const std::string& published) {
  return {rank > 0 ? std::to_string(rank) : "",
          row.method,
          with_interval(row.height.rmse_m, row.rmse_95_m),
          published,
          cell("{:+.2f}", 100 * row.height.bias_m),
          centimetres(row.height.mae_m),
          cell("{:.3f}", row.height.r2),
          centimetres(row.within.within_m),
          cell("{:.2f}", row.within.r2),
          cell("{:.2f}", row.within.rho),
          found_of(row),
          std::to_string(row.boxes.extra),
          cell("{:.3f}", row.boxes.iou_median),
          cell("{:.2f}", row.seconds)};
}

// A row a case, a column a method: RMSE, and how much that is more than the baseline's.
std::string changes_by_case(const SuiteResult& result, const std::vector<TableRow>& rows) {
  const std::vector<std::string> methods = methods_of(rows);
  Cells heads = {"case"};
  heads.insert(heads.end(), methods.begin(), methods.end());
  std::vector<Cells> lines;
  for (const CaseInfo& info : result.cases) {
    Cells cells = {info.name};
    for (const std::string& method : methods) {
      const auto row = std::ranges::find_if(rows, [&](const TableRow& candidate) {
        return candidate.method == method && candidate.case_name == info.name;
      });
      cells.push_back(row == rows.end() ? "-" : centimetres(row->height.rmse_m));
      if (row != rows.end() && info.name != *result.baseline)
        cells.back() += " (" + cell("{:+.2f}", 100 * row->rmse_change_m) + ")";
    }
    lines.push_back(std::move(cells));
  }
  return markdown_table(heads, lines);
}

std::string plots_found(const std::vector<TableRow>& rows) {
  const std::vector<Cells> lines = list_of(rows, [](const TableRow& row) {
    return Cells{row.method,
                 row.case_name,
                 std::to_string(row.boxes.plots),
                 std::to_string(row.boxes.found),
                 std::to_string(row.boxes.missed),
                 std::to_string(row.boxes.extra),
                 cell("{:.4f}", row.boxes.recall),
                 cell("{:.4f}", row.boxes.precision),
                 cell("{:.3f}", row.boxes.iou_mean),
                 cell("{:.3f}", row.boxes.iou_min),
                 centimetres(row.boxes.center_rmse_m),
                 cell("{:.3f}", degrees(row.boxes.heading_rmse_rad))};
  });
  return "\n## Plots found\n\n" +
         markdown_table(
             {"method", "case", "plots", "found", "missed", "extra", "recall", "precision",
              "IoU mean", "IoU least", "centre, cm rms", "heading, deg rms"},
             lines);
}

std::string own_truths(const std::vector<TableRow>& rows) {
  if (rows.empty()) return "";
  const std::vector<Cells> lines = list_of(rows, [](const TableRow& row) {
    return Cells{row.method,
                 row.truth,
                 row.case_name,
                 with_interval(row.height.rmse_m, row.rmse_95_m),
                 cell("{:+.2f}", 100 * row.height.bias_m),
                 centimetres(row.within.farm_bias_m),
                 centimetres(row.within.within_m),
                 cell("{:.2f}", row.within.r2),
                 cell("{:.2f}", row.within.rho),
                 percent(row.height.coverage95),
                 std::to_string(row.height.flagged),
                 unflagged(row)};
  });
  return "\n## Each height against the truth it is named after\n\n" +
         markdown_table({"method", "truth", "case", "RMSE [95 %]", "bias", "bias a farm",
                         "within farms", "R2 within", "rho within", "truths in its 95 % intervals",
                         "flagged plots", "over 5 cm without a flag"},
                        lines);
}

// The methods of a case against a truth, the best first.
std::string ranking(const SuiteResult& result, std::vector<TableRow> rows) {
  // NaN, a method without any height, comes last.
  std::ranges::stable_sort(rows, [](const TableRow& a, const TableRow& b) {
    if (has_place(a) != has_place(b)) return has_place(a);
    return a.height.rmse_m < b.height.rmse_m ||
           (std::isnan(b.height.rmse_m) && !std::isnan(a.height.rmse_m));
  });
  std::vector<Cells> lines;
  for (std::size_t i = 0; i < rows.size(); ++i)
    lines.push_back(
        leaderboard_cells(has_place(rows[i]) ? i + 1 : 0, rows[i], published_cm(result, rows[i])));
  return markdown_table(
      {"", "method", "RMSE [95 %]", "published", "bias", "MAE", "R2", "within farms", "R2 within",
       "rho within", "found", "extra", "IoU median", "seconds"},
      lines);
}

}  // namespace

std::string leaderboard(const SuiteResult& result, const std::vector<TableRow>& table) {
  std::string text =
      "# Suite " + result.suite +
      "\n\nRMSE, bias and MAE in cm over the plots found; 95 % bootstrap intervals "
      "over farms. Bias a farm: rms of the farms' own biases; within farms: rms of "
      "the errors less their farm's. Methods that measured fewer than 95 % of the plots, "
      "or more than 5 % of whose plots are none, have no place. All columns and "
      "truths are in table.csv.\n" +
      plots_found(plot_rows(result, table)) + own_truths(named_rows(table)) +
      failure_list("## Methods that gave up", result);
  for (const std::string& truth : shown_truths(result, table)) {
    if (!result.baseline) break;
    text += "\n## RMSE in cm (and its change against " + *result.baseline + "), truth " + truth +
            "\n\n" + changes_by_case(result, rows_against(truth, table));
  }
  for (const std::string& truth : shown_truths(result, table)) {
    for (const CaseInfo& info : result.cases) {
      std::vector<TableRow> rows = those_of(table, [&](const TableRow& row) {
        return row.truth == truth && row.case_name == info.name && row.shown;
      });
      if (rows.empty()) continue;
      text += "\n## " + info.name + ", truth " + truth + "\n\n" + ranking(result, std::move(rows));
    }
  }
  return text;
}

}  // namespace plotscan::farmbench
