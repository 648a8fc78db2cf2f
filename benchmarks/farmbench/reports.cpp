// SPDX-License-Identifier: Apache-2.0
#include "farmbench/reports.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/list_of.h"
#include "core/output_file.h"
#include "farmbench/figures.h"
#include "farmbench/internal/change_chart.h"
#include "farmbench/internal/failures.h"
#include "farmbench/internal/method_rows.h"
#include "farmbench/internal/suite_page.h"
#include "farmbench/internal/sweep_table.h"
#include "farmbench/markdown.h"

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

// The rows that are compared with one truth.
std::vector<TableRow> rows_against(const std::string& truth, const std::vector<TableRow>& table) {
  return by_method(table, [&](const TableRow& row) { return row.truth == truth && row.shown; });
}

// The rows whose height is named after the truth.
std::vector<TableRow> named_rows(const std::vector<TableRow>& table) {
  return by_method(table, [](const TableRow& row) { return row.named; });
}

// The published figure that belongs beside the row, "" where there is none.
std::string published_cm(const SuiteResult& result, const TableRow& row) {
  if (!result.published || std::ranges::count(result.published->methods, row.method) == 0)
    return "";
  const auto info = std::ranges::find(result.cases, row.case_name, &CaseInfo::name);
  if (info == result.cases.end() || !info->published_rmse_cm) return "";
  return fmt::format("{:.1f}", *info->published_rmse_cm);
}

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

// Plots found, heights named after truths; for each truth and case, the methods by RMSE.
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

// A table for terminals: the rows' methods, each on its first line only, their cases, and what
// `told` says of them under the heads; no line for a row that it says nothing of. The columns of
// names are as wide as the longest name, so that all columns stay in line.
std::vector<std::string> lines_of(const std::vector<TableRow>& rows, std::size_t method_width,
                                  const std::string& heads,
                                  const std::function<std::string(const TableRow&)>& told) {
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
    const std::string rest = told(row);
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

std::vector<std::string> shown_truths(const SuiteResult& result,
                                      const std::vector<TableRow>& table) {
  std::vector<std::string> shown = result.truths;
  if (shown.empty()) shown = {"height_max_m", "height_mean_m"};
  std::erase_if(shown, [&](const std::string& truth) {
    return std::ranges::find(table, truth, &TableRow::truth) == table.end();
  });
  return shown;
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
