// SPDX-License-Identifier: Apache-2.0
#include "farmbench/table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "core/angle.h"
#include "core/csv.h"
#include "core/statistics.h"
#include "farmbench/format.h"
#include "farmbench/internal/bootstrap.h"
#include "farmbench/internal/method_rows.h"
#include "score/height_score.h"
#include "score/score.h"

namespace plotscan::farmbench {
namespace {

// One method on all farms of one case.
struct CaseOfMethod {
  std::vector<MethodHeight> heights;
  std::vector<std::uint64_t> seeds = {};
  std::vector<score::FieldScore> fields = {};
  std::vector<double> seconds = {};
};

CaseOfMethod collect(const SuiteResult& result, const std::string& case_name,
                     const std::string& method) {
  CaseOfMethod collected{.heights = heights_of(result, method)};
  for (const FarmResult& farm : result.farms) {
    if (farm.case_name != case_name) continue;
    for (const MethodResult& run : farm.methods) {
      if (run.method != method) continue;
      collected.seeds.push_back(farm.seed);
      collected.fields.push_back(run.score);
      if (run.seconds > 0) collected.seconds.push_back(run.seconds);
    }
  }
  return collected;
}

std::set<std::string> truths_of(const std::vector<score::FieldScore>& fields) {
  std::set<std::string> truths;
  for (const score::FieldScore& field : fields) truths.merge(score::true_heights(field));
  return truths;
}

SquaredErrors squared_errors(const score::HeightPairs& pairs) {
  SquaredErrors errors{.count = pairs.estimates_m.size()};
  for (std::size_t i = 0; i < errors.count; ++i) {
    const double error_m = pairs.estimates_m[i] - pairs.truths_m[i];
    errors.sum += error_m * error_m;
  }
  return errors;
}

SquaredErrors summed(const std::vector<SquaredErrors>& farms) {
  SquaredErrors all;
  for (const SquaredErrors& farm : farms) {
    all.sum += farm.sum;
    all.count += farm.count;
  }
  return all;
}

// Four decimals, a hundred times finer than any of the figures is accurate. What could not be
// computed is an empty field.
std::string field_of(double value) {
  const double rounded = std::round(value * 1e4) / 1e4;
  return std::isnan(value) ? "" : format_number(rounded == 0 ? 0 : rounded);  // no "-0"
}

// A column of table.csv.
struct Column {
  const char* name;
  std::string (*field)(const TableRow&);
};

using Row = const TableRow&;

constexpr std::array kColumns = {
    Column{"suite", [](Row row) { return csv_field(row.suite); }},
    Column{"case", [](Row row) { return csv_field(row.case_name); }},
    Column{"method", [](Row row) { return csv_field(row.method); }},
    Column{"truth", [](Row row) { return csv_field(row.truth); }},
    Column{"farms", [](Row row) { return std::to_string(row.farms); }},
    Column{"plots", [](Row row) { return std::to_string(row.plots); }},
    Column{"found", [](Row row) { return std::to_string(row.found); }},
    Column{"missed", [](Row row) { return std::to_string(row.missed); }},
    Column{"extra", [](Row row) { return std::to_string(row.extra); }},
    Column{"without", [](Row row) { return std::to_string(row.without); }},
    Column{"recall", [](Row row) { return field_of(row.recall); }},
    Column{"precision", [](Row row) { return field_of(row.precision); }},
    Column{"iou_mean", [](Row row) { return field_of(row.iou_mean); }},
    Column{"iou_median", [](Row row) { return field_of(row.iou_median); }},
    Column{"iou_min", [](Row row) { return field_of(row.iou_min); }},
    Column{"center_rmse_cm", [](Row row) { return field_of(100 * row.center_rmse_m); }},
    Column{"heading_rmse_deg", [](Row row) { return field_of(degrees(row.heading_rmse_rad)); }},
    Column{"rmse_cm", [](Row row) { return field_of(100 * row.rmse_m); }},
    Column{"rmse_lo_cm", [](Row row) { return field_of(100 * row.rmse_low_m); }},
    Column{"rmse_hi_cm", [](Row row) { return field_of(100 * row.rmse_high_m); }},
    Column{"rmse_change_cm", [](Row row) { return field_of(100 * row.rmse_change_m); }},
    Column{"rmse_change_lo_cm", [](Row row) { return field_of(100 * row.rmse_change_low_m); }},
    Column{"rmse_change_hi_cm", [](Row row) { return field_of(100 * row.rmse_change_high_m); }},
    Column{"bias_cm", [](Row row) { return field_of(100 * row.bias_m); }},
    Column{"mae_cm", [](Row row) { return field_of(100 * row.mae_m); }},
    Column{"r2", [](Row row) { return field_of(row.r2); }},
    Column{"farm_bias_cm", [](Row row) { return field_of(100 * row.within.farm_bias_m); }},
    Column{"within_cm", [](Row row) { return field_of(100 * row.within.within_m); }},
    Column{"r2_within", [](Row row) { return field_of(row.within.r2); }},
    Column{"rho_within", [](Row row) { return field_of(row.within.rho); }},
    Column{"coverage95", [](Row row) { return field_of(row.coverage95); }},
    Column{"flagged", [](Row row) { return std::to_string(row.flagged); }},
    Column{"over_5cm_unflagged", [](Row row) { return std::to_string(row.large_unflagged); }},
    Column{"over_5cm_unflagged_share",
           [](Row row) { return field_of(row.large_unflagged_share); }}};

void set_boxes(TableRow& row, const CaseOfMethod& collected) {
  const score::BoxScore boxes = score::score_boxes(collected.fields);
  row.farms = collected.fields.size();
  row.plots = boxes.plots;
  row.found = boxes.found;
  row.missed = boxes.missed;
  row.extra = boxes.extra;
  row.recall = boxes.recall;
  row.precision = boxes.precision;
  row.iou_mean = boxes.iou_mean;
  row.iou_median = boxes.iou_median;
  row.iou_min = boxes.iou_min;
  row.center_rmse_m = boxes.center_rmse_m;
  row.heading_rmse_rad = boxes.heading_rmse_rad;
  row.seconds = quantile(collected.seconds, 0.5);
}

std::vector<SquaredErrors> errors_by_farm(const CaseOfMethod& collected, const std::string& height,
                                          const std::string& truth) {
  std::vector<SquaredErrors> by_farm;
  for (const score::FieldScore& field : collected.fields)
    by_farm.push_back(squared_errors(score::height_pairs(field, height, truth)));
  return by_farm;
}

void set_change(TableRow& row, const CaseOfMethod& baseline, const CaseOfMethod& collected,
                const std::string& height, std::uint64_t seed) {
  if (baseline.seeds != collected.seeds) return;
  const std::vector<SquaredErrors> before = errors_by_farm(baseline, height, row.truth);
  const std::vector<SquaredErrors> after = errors_by_farm(collected, height, row.truth);
  const Interval interval = bootstrap_rmse_change(before, after, seed);
  row.rmse_change_m = row.rmse_m - rmse(summed(before));
  row.rmse_change_low_m = interval.low;
  row.rmse_change_high_m = interval.high;
}

void set_heights(TableRow& row, const CaseOfMethod& collected, const std::string& height,
                 std::uint64_t seed) {
  std::vector<score::HeightPairs> by_farm;
  score::HeightPairs pooled;
  for (const score::FieldScore& field : collected.fields) {
    by_farm.push_back(score::height_pairs(field, height, row.truth));
    score::append(pooled, by_farm.back());
  }
  const score::HeightScore score = score::score_height(height, row.truth, pooled);
  const Interval interval = bootstrap_rmse(errors_by_farm(collected, height, row.truth), seed);
  row.without = score.without;
  row.rmse_m = score.rmse_m;
  row.rmse_low_m = interval.low;
  row.rmse_high_m = interval.high;
  row.bias_m = score.bias_m;
  row.mae_m = score.mae_m;
  row.r2 = score.r2;
  row.within = score::score_within(by_farm);
  row.coverage95 = score.coverage95;
  row.flagged = score.flagged;
  row.large_unflagged = score.large_unflagged;
  row.large_unflagged_share = score.large_unflagged_share;
}

// What was found where there is no plot.
TableRow row_without_plots(const std::string& suite, const std::string& case_name,
                           const CaseOfMethod& collected) {
  TableRow row{
      .suite = suite, .case_name = case_name, .method = collected.heights.front().row, .truth = {}};
  set_boxes(row, collected);
  set_heights(row, collected, collected.heights.front().height, 1);
  return row;
}

}  // namespace

std::vector<TableRow> make_table(const SuiteResult& result, std::uint64_t seed) {
  std::vector<TableRow> table;
  for (const CaseInfo& info : result.cases) {
    for (const std::string& method : result.methods) {
      const CaseOfMethod collected = collect(result, info.name, method);
      std::optional<CaseOfMethod> baseline;
      if (result.baseline) baseline.emplace(collect(result, *result.baseline, method));
      std::set<std::string> heights;
      for (const MethodHeight& height : collected.heights) heights.insert(height.height);
      const std::set<std::string> truths = truths_of(collected.fields);
      if (truths.empty() && !collected.fields.empty())
        table.push_back(row_without_plots(result.suite, info.name, collected));
      for (const MethodHeight& height : collected.heights) {
        for (const std::string& truth : truths) {
          TableRow row{.suite = result.suite,
                       .case_name = info.name,
                       .method = height.row,
                       .truth = truth,
                       .named = score::named_truth(height.height) == truth,
                       .shown = !height.height.empty() &&
                                score::heights_beside(truth, heights).contains(height.height)};
          set_boxes(row, collected);
          set_heights(row, collected, height.height, seed);
          if (baseline) set_change(row, *baseline, collected, height.height, seed);
          table.push_back(row);
        }
      }
    }
  }
  return table;
}

std::vector<std::string> methods_of(const std::vector<TableRow>& rows) {
  std::vector<std::string> methods;
  for (const TableRow& row : rows) {
    if (std::ranges::find(methods, row.method) == methods.end()) methods.push_back(row.method);
  }
  return methods;
}

nlohmann::json to_json(const TableRow& row) {
  return {{"case", row.case_name},
          {"method", row.method},
          {"truth", row.truth},
          {"farms", row.farms},
          {"plots", row.plots},
          {"found", row.found},
          {"missed", row.missed},
          {"extra", row.extra},
          {"without", row.without},
          {"recall", row.recall},
          {"precision", row.precision},
          {"iou_mean", row.iou_mean},
          {"iou_median", row.iou_median},
          {"iou_min", row.iou_min},
          {"center_rmse_m", row.center_rmse_m},
          {"heading_rmse_deg", degrees(row.heading_rmse_rad)},
          {"rmse_m", row.rmse_m},
          {"rmse_95_m", {row.rmse_low_m, row.rmse_high_m}},
          {"rmse_change_m", row.rmse_change_m},
          {"rmse_change_95_m", {row.rmse_change_low_m, row.rmse_change_high_m}},
          {"bias_m", row.bias_m},
          {"mae_m", row.mae_m},
          {"r2", row.r2},
          {"farm_bias_m", row.within.farm_bias_m},
          {"within_m", row.within.within_m},
          {"r2_within", row.within.r2},
          {"rho_within", row.within.rho},
          {"coverage95", row.coverage95},
          {"flagged", row.flagged},
          {"over_5cm_unflagged", row.large_unflagged},
          {"over_5cm_unflagged_share", row.large_unflagged_share},
          {"seconds", row.seconds}};
}

std::string table_csv(const std::vector<TableRow>& table) {
  std::string text;
  for (const Column& column : kColumns) text.append(column.name).append(",");
  text.back() = '\n';
  for (const TableRow& row : table) {
    for (const Column& column : kColumns) text.append(column.field(row)).append(",");
    text.back() = '\n';
  }
  return text;
}

}  // namespace plotscan::farmbench
