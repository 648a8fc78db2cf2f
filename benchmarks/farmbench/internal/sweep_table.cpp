// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/sweep_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/text.h"
#include "farmbench/figure_text.h"
#include "farmbench/internal/failures.h"
#include "farmbench/internal/method_rows.h"
#include "farmbench/markdown.h"

namespace plotscan::farmbench {
namespace {

std::size_t place_of(const SuiteResult& result, const std::string& case_name) {
  const auto found = std::ranges::find(result.cases, case_name, &CaseInfo::name);
  check(found != result.cases.end(), "a table of other cases");
  return found - result.cases.begin();
}

Cells values_of(const SuiteResult& result, const TableRow& row) {
  return list_of(combination(*result.sweep, place_of(result, row.case_name)), text_of);
}

Cells axis_keys(const SuiteResult& result) { return list_of(result.sweep->axes, &SweepAxis::key); }

// A value with this many decimals; an empty field where it could not be computed.
std::string rounded(double value, int decimals) {
  const double power = std::pow(10.0, decimals);
  return std::isnan(value) ? "" : format_number(std::round(value * power) / power);
}

std::string csv_line(const Cells& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + csv_field(cell);
  return line + "\n";
}

// "altitude_m 20, speed_m_s 4, sensor vlp16".
std::string named_values(const SuiteResult& result, const TableRow& row) {
  const Cells keys = axis_keys(result);
  const Cells values = values_of(result, row);
  Cells named;
  for (std::size_t i = 0; i < keys.size(); ++i) named.push_back(keys[i] + " " + values[i]);
  return joined(named, ", ");
}

std::string answer(const SuiteResult& result, const std::vector<TableRow>& rows) {
  if (!result.sweep->goal) return "";
  const SweepGoal& goal = *result.sweep->goal;
  const std::string asked =
      fmt::format("RMSE of at most {} cm (upper end of its 95 % interval), {} % of the plots found",
                  format_number(100 * goal.rmse_m), format_number(100 * goal.found));
  const auto needed = flight_needed(result, rows);
  if (!needed) return asked + ": none of these flights.";
  const TableRow& row = rows[*needed];
  const double flight_s = flight_costs(result)[place_of(result, row.case_name)].flight_s;
  if (std::isnan(flight_s))  // a submission, scored where no flight was flown
    return asked + ": reached, but the flights' times are not known; farmbench sweep flies them.";
  return asked + fmt::format(": the shortest flight that does has {}; {:.0f} s over {} plots.",
                             named_values(result, row), flight_s,
                             row.farms == 0 ? 0 : row.boxes.plots / row.farms);
}

std::string about(const SuiteResult& result) {
  return fmt::format("RMSE and bias in cm of {} over the plots found, against {}",
                     asked_row(result), result.sweep->truth);
}

// The upper end of the RMSE's interval; of a single farm, which has none, the RMSE.
double surely_at_most(const TableRow& row) {
  return std::isnan(row.rmse_95_m.high) ? row.height.rmse_m : row.rmse_95_m.high;
}

// The cells of a row for people.
Cells shown_cells(const SuiteResult& result, const TableRow& row) {
  const FlightCost cost = flight_costs(result)[place_of(result, row.case_name)];
  Cells cells = values_of(result, row);
  cells.insert(
      cells.end(),
      {with_interval(row.height.rmse_m, row.rmse_95_m), cell("{:+.2f}", 100 * row.height.bias_m),
       fmt::format("{} of {}", row.boxes.found, row.boxes.plots), std::to_string(row.boxes.extra),
       std::isnan(cost.flight_s) ? "none" : cell("{:.0f}", cost.flight_s),
       cell("{:.2f}", 1e-6 * cost.points)});
  return cells;
}

Cells shown_heads(const SuiteResult& result) {
  Cells heads = axis_keys(result);
  heads.insert(heads.end(), {"RMSE [95 %]", "bias", "found", "extra", "flight, s", "Mpoints"});
  return heads;
}

}  // namespace

std::string asked_row(const SuiteResult& result) {
  for (const MethodHeight& height : heights_of(result, result.methods.front()))
    if (height.height == result.sweep->height) return height.row;
  return "";  // an entered method that never gave it
}

std::vector<FlightCost> flight_costs(const SuiteResult& result) {
  std::vector<FlightCost> costs(result.cases.size());
  std::vector<double> flown(result.cases.size());
  for (const FarmResult& farm : result.farms) {
    if (farm.flight_s == 0) continue;  // it was not flown, or saw nothing
    const std::size_t i = place_of(result, farm.case_name);
    flown[i] += 1;
    costs[i].flight_s += farm.flight_s;
    costs[i].points += static_cast<double>(farm.points);
  }
  for (std::size_t i = 0; i < costs.size(); ++i) {
    costs[i].flight_s /= flown[i];
    costs[i].points /= flown[i];
  }
  return costs;
}

std::vector<TableRow> sweep_rows(const SuiteResult& result, const std::vector<TableRow>& table) {
  return those_of(table, [&, asked = asked_row(result)](const TableRow& row) {
    return row.method == asked && row.truth == result.sweep->truth;
  });
}

std::optional<std::size_t> flight_needed(const SuiteResult& result,
                                         const std::vector<TableRow>& rows) {
  if (!result.sweep->goal) return std::nullopt;
  const SweepGoal& goal = *result.sweep->goal;
  const std::vector<FlightCost> costs = flight_costs(result);
  const auto cost = [&](std::size_t i) {
    return costs[place_of(result, rows[i].case_name)].flight_s;
  };
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool reached =
        surely_at_most(rows[i]) <= goal.rmse_m && rows[i].boxes.recall >= goal.found;
    if (reached && (!best || cost(i) < cost(*best))) best = i;
  }
  return best;
}

std::string sweep_csv(const SuiteResult& result, const std::vector<TableRow>& table) {
  Cells heads = axis_keys(result);
  for (const char* name :
       {"method", "truth", "farms", "plots", "found", "missed", "extra", "recall", "rmse_cm",
        "rmse_lo_cm", "rmse_hi_cm", "bias_cm", "within_cm", "flight_s", "points"})
    heads.emplace_back(name);
  std::string text = csv_line(heads);
  const std::vector<FlightCost> costs = flight_costs(result);
  for (const TableRow& row : table) {
    if (!row.named && (!row.shown || row.truth != result.sweep->truth)) continue;
    const FlightCost& cost = costs[place_of(result, row.case_name)];
    Cells cells = values_of(result, row);
    cells.insert(cells.end(), {row.method, row.truth});
    for (const std::size_t count :
         {row.farms, row.boxes.plots, row.boxes.found, row.boxes.missed, row.boxes.extra})
      cells.push_back(std::to_string(count));
    for (const double value :
         {row.boxes.recall, 100 * row.height.rmse_m, 100 * row.rmse_95_m.low,
          100 * row.rmse_95_m.high, 100 * row.height.bias_m, 100 * row.within.within_m})
      cells.push_back(rounded(value, 4));
    cells.insert(cells.end(), {rounded(cost.flight_s, 1), rounded(cost.points, 0)});
    text += csv_line(cells);
  }
  return text;
}

std::string sweep_markdown(const SuiteResult& result, const std::vector<TableRow>& table) {
  const std::vector<TableRow> rows = sweep_rows(result, table);
  std::string text = "# Sweep " + result.suite + "\n\n" + about(result) +
                     ", with 95 % bootstrap intervals over farms.\n\n";
  if (const std::string said = answer(result, rows); !said.empty()) text += said + "\n\n";
  const std::vector<Cells> lines =
      list_of(rows, [&](const TableRow& row) { return shown_cells(result, row); });
  return text + markdown_table(shown_heads(result), lines) + failure_list("Gave up:", result);
}

std::vector<std::string> sweep_lines(const SuiteResult& result,
                                     const std::vector<TableRow>& table) {
  const std::vector<TableRow> rows = sweep_rows(result, table);
  std::vector<Cells> all = {shown_heads(result)};
  for (const TableRow& row : rows) all.push_back(shown_cells(result, row));
  std::vector<std::size_t> widths(all.front().size());
  for (const Cells& cells : all)
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  std::vector<std::string> lines = {about(result)};
  for (const Cells& cells : all) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i)
      line += (i == 0 ? "" : "  ") + std::string(widths[i] - cells[i].size(), ' ') + cells[i];
    lines.push_back(line);
  }
  if (const std::string said = answer(result, rows); !said.empty())
    lines.insert(lines.end(), {"", said});
  add_failures(result, lines);
  return lines;
}

}  // namespace plotscan::farmbench
