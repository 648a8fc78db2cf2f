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

std::vector<score::HeightPairs> pairs_by_farm(const CaseOfMethod& collected,
                                              const std::string& height, const std::string& truth) {
  std::vector<score::HeightPairs> farms;
  for (const score::FieldScore& field : collected.fields)
    farms.push_back(score::height_pairs(field, height, truth));
  return farms;
}

std::vector<SquaredErrors> squared_errors(const std::vector<score::HeightPairs>& farms) {
  std::vector<SquaredErrors> errors;
  for (const score::HeightPairs& farm : farms) {
    SquaredErrors& own = errors.emplace_back();
    own.count = farm.estimates_m.size();
    for (std::size_t i = 0; i < own.count; ++i) {
      const double error_m = farm.estimates_m[i] - farm.truths_m[i];
      own.sum += error_m * error_m;
    }
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
    Column{"plots", [](Row row) { return std::to_string(row.boxes.plots); }},
    Column{"found", [](Row row) { return std::to_string(row.boxes.found); }},
    Column{"missed", [](Row row) { return std::to_string(row.boxes.missed); }},
    Column{"extra", [](Row row) { return std::to_string(row.boxes.extra); }},
    Column{"without", [](Row row) { return std::to_string(row.height.without); }},
    Column{"recall", [](Row row) { return field_of(row.boxes.recall); }},
    Column{"precision", [](Row row) { return field_of(row.boxes.precision); }},
    Column{"iou_mean", [](Row row) { return field_of(row.boxes.iou_mean); }},
    Column{"iou_median", [](Row row) { return field_of(row.boxes.iou_median); }},
    Column{"iou_min", [](Row row) { return field_of(row.boxes.iou_min); }},
    Column{"center_rmse_cm", [](Row row) { return field_of(100 * row.boxes.center_rmse_m); }},
    Column{"heading_rmse_deg",
           [](Row row) { return field_of(degrees(row.boxes.heading_rmse_rad)); }},
    Column{"rmse_cm", [](Row row) { return field_of(100 * row.height.rmse_m); }},
    Column{"rmse_lo_cm", [](Row row) { return field_of(100 * row.rmse_95_m.low); }},
    Column{"rmse_hi_cm", [](Row row) { return field_of(100 * row.rmse_95_m.high); }},
    Column{"rmse_change_cm", [](Row row) { return field_of(100 * row.rmse_change_m); }},
    Column{"rmse_change_lo_cm", [](Row row) { return field_of(100 * row.rmse_change_95_m.low); }},
    Column{"rmse_change_hi_cm", [](Row row) { return field_of(100 * row.rmse_change_95_m.high); }},
    Column{"bias_cm", [](Row row) { return field_of(100 * row.height.bias_m); }},
    Column{"mae_cm", [](Row row) { return field_of(100 * row.height.mae_m); }},
    Column{"r2", [](Row row) { return field_of(row.height.r2); }},
    Column{"farm_bias_cm", [](Row row) { return field_of(100 * row.within.farm_bias_m); }},
    Column{"within_cm", [](Row row) { return field_of(100 * row.within.within_m); }},
    Column{"r2_within", [](Row row) { return field_of(row.within.r2); }},
    Column{"rho_within", [](Row row) { return field_of(row.within.rho); }},
    Column{"coverage95", [](Row row) { return field_of(row.height.coverage95); }},
    Column{"flagged", [](Row row) { return std::to_string(row.height.flagged); }},
    Column{"over_5cm_unflagged",
           [](Row row) { return std::to_string(row.height.large_unflagged); }},
    Column{"over_5cm_unflagged_share",
           [](Row row) { return field_of(row.height.large_unflagged_share); }}};

// What all rows of the case and the method have in common.
TableRow common_row(const SuiteResult& result, const std::string& case_name,
                    const CaseOfMethod& collected) {
  return {.suite = result.suite,
          .case_name = case_name,
          .method = collected.heights.front().row,
          .truth = {},
          .farms = collected.fields.size(),
          .boxes = score::score_boxes(collected.fields),
          .seconds = quantile(collected.seconds, 0.5)};
}

void set_change(TableRow& row, const CaseOfMethod& baseline, const CaseOfMethod& collected,
                const std::string& height, std::uint64_t seed) {
  if (baseline.seeds != collected.seeds) return;
  const auto before = squared_errors(pairs_by_farm(baseline, height, row.truth));
  const auto after = squared_errors(pairs_by_farm(collected, height, row.truth));
  row.rmse_change_m = row.height.rmse_m - rmse(summed(before));
  row.rmse_change_95_m = bootstrap_rmse_change(before, after, seed);
}

void set_heights(TableRow& row, const CaseOfMethod& collected, const std::string& height,
                 std::uint64_t seed) {
  const std::vector<score::HeightPairs> farms = pairs_by_farm(collected, height, row.truth);
  score::HeightPairs pooled;
  for (const score::HeightPairs& farm : farms) score::append(pooled, farm);
  row.height = score::score_height(height, row.truth, pooled);
  row.rmse_95_m = bootstrap_rmse(squared_errors(farms), seed);
  row.within = score::score_within(farms);
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
      const TableRow common = common_row(result, info.name, collected);
      if (truths.empty() && !collected.fields.empty()) {  // what was found where there is no plot
        table.push_back(common);
        set_heights(table.back(), collected, collected.heights.front().height, 1);
      }
      for (const auto& [height, name] : collected.heights) {
        for (const std::string& truth : truths) {
          TableRow& row = table.emplace_back(common);
          row.method = name;
          row.truth = truth;
          row.named = score::named_truth(height) == truth;
          row.shown = !height.empty() && score::heights_beside(truth, heights).contains(height);
          set_heights(row, collected, height, seed);
          if (baseline) set_change(row, *baseline, collected, height, seed);
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

void to_json(nlohmann::json& document, const TableRow& row) {
  document = {{"case", row.case_name},
              {"method", row.method},
              {"truth", row.truth},
              {"farms", row.farms},
              {"plots", row.boxes.plots},
              {"found", row.boxes.found},
              {"missed", row.boxes.missed},
              {"extra", row.boxes.extra},
              {"without", row.height.without},
              {"recall", row.boxes.recall},
              {"precision", row.boxes.precision},
              {"iou_mean", row.boxes.iou_mean},
              {"iou_median", row.boxes.iou_median},
              {"iou_min", row.boxes.iou_min},
              {"center_rmse_m", row.boxes.center_rmse_m},
              {"heading_rmse_deg", degrees(row.boxes.heading_rmse_rad)},
              {"rmse_m", row.height.rmse_m},
              {"rmse_95_m", {row.rmse_95_m.low, row.rmse_95_m.high}},
              {"rmse_change_m", row.rmse_change_m},
              {"rmse_change_95_m", {row.rmse_change_95_m.low, row.rmse_change_95_m.high}},
              {"bias_m", row.height.bias_m},
              {"mae_m", row.height.mae_m},
              {"r2", row.height.r2},
              {"farm_bias_m", row.within.farm_bias_m},
              {"within_m", row.within.within_m},
              {"r2_within", row.within.r2},
              {"rho_within", row.within.rho},
              {"coverage95", row.height.coverage95},
              {"flagged", row.height.flagged},
              {"over_5cm_unflagged", row.height.large_unflagged},
              {"over_5cm_unflagged_share", row.height.large_unflagged_share},
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
