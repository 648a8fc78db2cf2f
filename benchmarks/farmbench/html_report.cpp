// SPDX-License-Identifier: Apache-2.0
#include "farmbench/html_report.h"

#include "core/manifest.h"
#include "farmbench/charts.h"
#include "farmbench/format.h"
#include "farmbench/reports.h"
#include "farmbench/svg.h"

namespace plotscan::farmbench {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Plotscan benchmark</title>
<style>
body { font: 15px/1.5 system-ui, sans-serif; color: #222; max-width: 74rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2.2rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 13.5px; width: 100%; }
th, td { padding: .22rem .5rem; text-align: right; white-space: nowrap; }
th:nth-child(-n+2), td:nth-child(-n+2) { text-align: left; }
th { border-bottom: 2px solid #888; font-weight: 600; }
tr.first td { border-top: 1px solid #ccc; }
svg { max-width: 100%; height: auto; } .charts { display: flex; flex-wrap: wrap; gap: 1rem; }
p.note { color: #555; }
</style></head><body>
)";

std::string table_row(const SuiteResult& result, const TableRow& row, bool first_of_method) {
  const auto cell = [](const std::string& text) { return "<td>" + text + "</td>"; };
  return (first_of_method ? "<tr class=\"first\">" : "<tr>") +
         cell(first_of_method ? escaped(row.method) : "") + cell(escaped(row.case_name)) +
         cell(formatted("%zu / %zu", row.found, row.plots)) + cell(std::to_string(row.extra)) +
         cell(number("%.3f", row.iou_median)) + cell(number("%.3f", row.iou_min)) +
         cell(with_interval(row.rmse_m, row.rmse_low_m, row.rmse_high_m)) +
         cell(with_interval(row.rmse_change_m, row.rmse_change_low_m, row.rmse_change_high_m)) +
         cell(published_cm(result, row)) + cell(number("%+.2f", 100 * row.bias_m)) +
         cell(number("%.2f", 100 * row.mae_m)) + cell(number("%.3f", row.r2)) +
         cell(centimetres(row.within.within_m)) + cell(number("%.2f", row.within.r2)) +
         cell(number("%.2f", row.within.rho)) + cell(number("%.2f", row.seconds)) + "</tr>\n";
}

std::string table_of(const SuiteResult& result, const std::vector<TableRow>& rows) {
  std::string text =
      "<table><tr><th>method</th><th>case</th><th>found</th><th>extra</th><th>IoU median</th>"
      "<th>IoU least</th><th>RMSE [95&nbsp;%], cm</th><th>change, "
      "cm</th><th>published</th><th>bias, cm</th>"
      "<th>MAE, cm</th><th>R&sup2;</th><th>within farms, cm</th><th>R&sup2; within</th>"
      "<th>&rho; within</th><th>s</th></tr>\n";
  std::string method;
  for (const TableRow& row : rows) {
    text += table_row(result, row, row.method != method);
    method = row.method;
  }
  return text + "</table>\n";
}

std::string html_row(const std::vector<std::string>& cells, const char* cell) {
  std::string text = "<tr>";
  for (const std::string& content : cells)
    text += std::string("<") + cell + ">" + content + "</" + cell + ">";
  return text + "</tr>\n";
}

std::string plots_found(const std::vector<TableRow>& rows) {
  std::string text =
      "<h2>Plots found</h2>\n<table>" +
      html_row({"method", "case", "plots", "found", "missed", "extra", "recall", "precision",
                "IoU mean", "IoU least", "centre, cm rms", "heading, deg rms"},
               "th");
  for (const TableRow& row : rows) {
    text +=
        html_row({escaped(row.method), escaped(row.case_name), std::to_string(row.plots),
                  std::to_string(row.found), std::to_string(row.missed), std::to_string(row.extra),
                  number("%.4f", row.recall), number("%.4f", row.precision),
                  number("%.3f", row.iou_mean), number("%.3f", row.iou_min),
                  centimetres(row.center_rmse_m), number("%.3f", degrees(row.heading_rmse_rad))},
                 "td");
  }
  return text + "</table>\n";
}

std::string own_truths(const std::vector<TableRow>& rows) {
  if (rows.empty()) return "";
  std::string text =
      "<h2>Each height against the truth it is named after</h2>\n<table>" +
      html_row({"method", "case", "truth", "RMSE [95&nbsp;%], cm", "bias, cm", "bias a farm, cm",
                "within farms, cm", "R&sup2; within", "&rho; within",
                "truths in its 95&nbsp;% intervals", "flagged plots", "over 5 cm without a flag"},
               "th");
  for (const TableRow& row : rows) {
    text += html_row({escaped(row.method), escaped(row.case_name), escaped(row.truth),
                      with_interval(row.rmse_m, row.rmse_low_m, row.rmse_high_m),
                      number("%+.2f", 100 * row.bias_m), centimetres(row.within.farm_bias_m),
                      centimetres(row.within.within_m), number("%.2f", row.within.r2),
                      number("%.2f", row.within.rho), percent(row.coverage95),
                      std::to_string(row.flagged), unflagged(row)},
                     "td");
  }
  return text + "</table>\n";
}

std::string scan_note(const SuiteResult& result) {
  double shots = 0;
  double points = 0;
  for (const FarmResult& farm : result.farms) {
    shots += static_cast<double>(farm.shots);
    points += static_cast<double>(farm.points);
  }
  std::string text =
      "<p class=\"note\">" +
      formatted("%zu farms, %.0f million shots, %.0f million points. ", result.farms.size(),
                shots / 1e6, points / 1e6) +
      "Heights are scored over the plots found (boxes that overlap a true one by an "
      "intersection over union of at least 0.5, one to one). Intervals are 95 % "
      "percentile bootstrap over farms. Bias a farm: root mean square of the farms' own "
      "biases; within farms: root mean square of the errors less their farm's bias, "
      "and how well the order of a farm's plots is kept.";
  if (result.published) {
    text += " Published: RMSE in " + escaped(result.published->source) + ", cm.";
  }
  return text + "</p>\n";
}

}  // namespace

std::string html_report(const SuiteResult& result, const std::vector<TableRow>& table) {
  std::string page = kHead;
  page += "<h1>Suite " + escaped(result.suite) + "</h1>\n" + scan_note(result) +
          plots_found(plot_rows(result, table)) + own_truths(named_rows(table));
  for (const std::string& truth : shown_truths(result, table)) {
    const std::vector<TableRow> rows = rows_by_method(table, truth);
    page += "<h2>Against " + escaped(truth) + "</h2>\n" + table_of(result, rows) +
            (result.baseline ? change_chart(result, rows) : rmse_chart(result, rows));
  }
  for (const std::string& truth : shown_truths(result, table)) {
    page += "<h2>Estimated height against " + escaped(truth) + "</h2>\n<div class=\"charts\">";
    for (const CaseInfo& info : result.cases) page += height_chart(result, info.name, truth);
    page += "</div>\n";
  }
  return page + "<p class=\"note\">Plotscan " + escaped(version()) +
         "; every figure is in table.csv and results.json.</p>\n</body></html>\n";
}

}  // namespace plotscan::farmbench
