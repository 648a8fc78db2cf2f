// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/suite_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "core/list_of.h"
#include "core/output_file.h"
#include "farmbench/internal/chosen_rows.h"
#include "farmbench/internal/farm_view.h"
#include "farmbench/internal/method_rows.h"
#include "farmbench/internal/sweep_table.h"
#include "report/decimals.h"
#include "report/page.h"

namespace plotscan::farmbench {
namespace {

using nlohmann::json;

json or_null(double value) {
  constexpr int kDecimals = 5;  // of metres
  return std::isfinite(value) ? json(report::decimals(value, kDecimals)) : json();
}

// The row as --json prints it, rounded, with the columns of pages.
json packed(const TableRow& row) {
  json document = row;
  for (const char* key : {"iou_median", "rmse_95_m", "rmse_change_95_m", "over_5cm_unflagged",
                          "over_5cm_unflagged_share"})
    document.erase(key);
  document.update({{"named", row.named},
                   {"shown", row.shown},
                   {"rmse_low_m", row.rmse_95_m.low},
                   {"rmse_high_m", row.rmse_95_m.high},
                   {"rmse_change_low_m", row.rmse_change_95_m.low},
                   {"rmse_change_high_m", row.rmse_change_95_m.high},
                   {"large_unflagged", row.height.large_unflagged}});
  for (json& value : document)
    if (value.is_number_float()) value = or_null(value.get<double>());
  return document;
}

const std::vector<score::PlotScore>& plots_of(const FarmResult& farm) {
  static const std::vector<score::PlotScore> none;
  return farm.methods.empty() ? none : farm.methods.front().score.plots;
}

json value_or_null(const std::map<std::string, double>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? json() : or_null(found->second);
}

// Every true plot of the suite, farm after farm.
json truths_of(const SuiteResult& result) {
  std::set<std::string> names;
  for (const FarmResult& farm : result.farms)
    for (const score::PlotScore& plot : plots_of(farm))
      for (const auto& [name, value] : plot.truth.heights_m) names.insert(name);
  json truths = json::object();
  for (const std::string& name : names) {
    json& values = truths[name] = json::array();
    for (const FarmResult& farm : result.farms)
      for (const score::PlotScore& plot : plots_of(farm))
        values.push_back(value_or_null(plot.truth.heights_m, name));
  }
  return truths;
}

json estimate_of(const score::PlotScore& plot, const std::string& height) {
  return plot.found ? value_or_null(plot.found->heights_m, height) : json();
}

// What a method says of the plots of truths_of, null where it says nothing.
json series_of(const SuiteResult& result, const std::string& method, const MethodHeight& height) {
  json values = json::array();
  for (const FarmResult& farm : result.farms) {
    const auto run = std::ranges::find(farm.methods, method, &MethodResult::method);
    const bool ran = run != farm.methods.end() && run->score.plots.size() == plots_of(farm).size();
    for (std::size_t i = 0; i < plots_of(farm).size(); ++i)
      values.push_back(ran ? estimate_of(run->score.plots[i], height.height) : json());
  }
  return {{"row", height.row}, {"height", height.height}, {"values", std::move(values)}};
}

json farms_of(const SuiteResult& result) {
  json farms = json::array();
  for (const FarmResult& farm : result.farms) {
    farms.push_back({{"case", farm.case_name},
                     {"seed", farm.seed},
                     {"plot_numbers", list_of(plots_of(farm), [](const score::PlotScore& plot) {
                        return plot.truth.id;
                      })}});
  }
  return farms;
}

// Those of heights that reports hold against the truth.
std::vector<TableRow> shown_rows(std::vector<TableRow> table) {
  std::erase_if(table, [](const TableRow& row) { return !row.shown && !row.named; });
  return table;
}

// What was asked, and what each combination's flights cost.
json sweep_of(const SuiteResult& result) {
  json document = *result.sweep;
  document["row"] = asked_row(result);
  json& flights = document["flights"] = json::array();
  for (const FlightCost& cost : flight_costs(result))
    flights.push_back({{"flight_s", or_null(cost.flight_s)}, {"points", or_null(cost.points)}});
  return document;
}

}  // namespace

json suite_document(const SuiteResult& result, const std::vector<TableRow>& table) {
  json document = {{"name", result.suite},
                   {"cases", result.cases},
                   {"truths", shown_truths(result, table)},
                   {"farms", farms_of(result)},
                   {"table", list_of(shown_rows(table), packed)},
                   {"boxes", list_of(plot_rows(result, table), packed)}};
  if (result.sweep) {
    document["sweep"] = sweep_of(result);
    return document;
  }
  document["plots"] = truths_of(result);
  json& series = document["series"] = json::array();
  for (const std::string& method : result.methods)
    for (const MethodHeight& height : heights_of(result, method))
      series.push_back(series_of(result, method, height));
  if (result.published) document["published"] = *result.published;
  if (result.baseline) document["baseline"] = *result.baseline;
  return document;
}

void write_suite_page(const std::filesystem::path& folder, const SuiteResult& result,
                      const std::vector<TableRow>& table) {
  json fields = json::array();
  std::set<std::string> seen;
  for (const FarmResult& farm : result.farms) {
    if (!seen.insert(farm.case_name).second) continue;
    if (auto view = read_farm_view(farm_view_file(folder, farm_name(farm.case_name, farm.seed))))
      fields.push_back(std::move(*view));
  }
  OutputFile file(folder / "report.html", true);
  report::write_page(file.path(), {{"kind", "suite"},
                                   {"title", (result.sweep ? "Sweep " : "Suite ") + result.suite},
                                   {"fields", std::move(fields)},
                                   {"suite", suite_document(result, table)}});
  file.commit();
}

}  // namespace plotscan::farmbench
