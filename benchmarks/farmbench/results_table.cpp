// SPDX-License-Identifier: Apache-2.0
#include "farmbench/results_table.h"

#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "core/angle.h"
#include "core/contains.h"
#include "core/csv.h"
#include "farmbench/figure_text.h"
#include "farmbench/internal/bootstrap.h"
#include "farmbench/internal/method_rows.h"

namespace plotscan::farmbench {
namespace {

using nlohmann::json;

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

// A figure of a row: a column of table.csv and a member of its JSON.
struct Figure {
  const char* name;  // without the unit of a length
  json (*of)(const TableRow&);
  bool is_length = false;  // metres in JSON, centimetres in table.csv
};

using Row = const TableRow&;

constexpr std::array kFigures = {
    Figure{"case", [](Row row) -> json { return row.case_name; }},
    Figure{"method", [](Row row) -> json { return row.method; }},
    Figure{"truth", [](Row row) -> json { return row.truth; }},
    Figure{"farms", [](Row row) -> json { return row.farms; }},
    Figure{"plots", [](Row row) -> json { return row.boxes.plots; }},
    Figure{"found", [](Row row) -> json { return row.boxes.found; }},
    Figure{"missed", [](Row row) -> json { return row.boxes.missed; }},
    Figure{"extra", [](Row row) -> json { return row.boxes.extra; }},
    Figure{"without", [](Row row) -> json { return row.height.without; }},
    Figure{"recall", [](Row row) -> json { return row.boxes.recall; }},
    Figure{"precision", [](Row row) -> json { return row.boxes.precision; }},
    Figure{"iou_mean", [](Row row) -> json { return row.boxes.iou_mean; }},
    Figure{"iou_median", [](Row row) -> json { return row.boxes.iou_median; }},
    Figure{"iou_min", [](Row row) -> json { return row.boxes.iou_min; }},
    Figure{"center_rmse", [](Row row) -> json { return row.boxes.center_rmse_m; }, true},
    Figure{"heading_rmse_deg", [](Row row) -> json { return degrees(row.boxes.heading_rmse_rad); }},
    Figure{"rmse", [](Row row) -> json { return row.height.rmse_m; }, true},
    Figure{"rmse_lo", [](Row row) -> json { return row.rmse_95_m.low; }, true},
    Figure{"rmse_hi", [](Row row) -> json { return row.rmse_95_m.high; }, true},
    Figure{"rmse_change", [](Row row) -> json { return row.rmse_change_m; }, true},
    Figure{"rmse_change_lo", [](Row row) -> json { return row.rmse_change_95_m.low; }, true},
    Figure{"rmse_change_hi", [](Row row) -> json { return row.rmse_change_95_m.high; }, true},
    Figure{"bias", [](Row row) -> json { return row.height.bias_m; }, true},
    Figure{"mae", [](Row row) -> json { return row.height.mae_m; }, true},
    Figure{"r2", [](Row row) -> json { return row.height.r2; }},
    Figure{"farm_bias", [](Row row) -> json { return row.within.farm_bias_m; }, true},
    Figure{"within", [](Row row) -> json { return row.within.within_m; }, true},
    Figure{"r2_within", [](Row row) -> json { return row.within.r2; }},
    Figure{"rho_within", [](Row row) -> json { return row.within.rho; }},
    Figure{"coverage95", [](Row row) -> json { return row.height.coverage95; }},
    Figure{"flagged", [](Row row) -> json { return row.height.flagged; }},
    Figure{"over_5cm_unflagged", [](Row row) -> json { return row.height.large_unflagged; }},
    Figure{"over_5cm_unflagged_share",
           [](Row row) -> json { return row.height.large_unflagged_share; }}};

// Numbers to four decimals, a hundred times finer than any of the figures is accurate. What could
// not be computed is an empty field.
std::string field_of(const Figure& figure, const TableRow& row) {
  const json value = figure.of(row);
  if (value.is_string()) return csv_field(value.get<std::string>());
  if (!value.is_number_float()) return value.dump();
  const double value_shown = (figure.is_length ? 100 : 1) * value.get<double>();
  const double rounded = std::round(value_shown * 1e4) / 1e4;
  return std::isnan(rounded) ? "" : format_number(rounded == 0 ? 0 : rounded);  // no "-0"
}

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
  const auto errors_of = [&](const CaseOfMethod& run) {
    return squared_errors(score::score_on_farms(run.fields, height, row.truth).farms);
  };
  const std::vector<SquaredErrors> before = errors_of(baseline), after = errors_of(collected);
  row.rmse_change_m = row.height.rmse_m - rmse(summed(before));
  row.rmse_change_95_m = bootstrap_rmse_change(before, after, seed);
}

void set_heights(TableRow& row, const CaseOfMethod& collected, const std::string& height,
                 std::uint64_t seed) {
  const score::HeightOnFarms on = score::score_on_farms(collected.fields, height, row.truth);
  row.height = on.score;
  row.rmse_95_m = bootstrap_rmse(squared_errors(on.farms), seed);
  row.within = on.within;
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
    if (!contains(methods, row.method)) methods.push_back(row.method);
  }
  return methods;
}

void to_json(json& document, const TableRow& row) {
  for (const Figure& figure : kFigures)
    document[figure.name + std::string(figure.is_length ? "_m" : "")] = figure.of(row);
  for (const char* end : {"rmse_lo_m", "rmse_hi_m", "rmse_change_lo_m", "rmse_change_hi_m"})
    document.erase(end);
  document["rmse_95_m"] = {row.rmse_95_m.low, row.rmse_95_m.high};
  document["rmse_change_95_m"] = {row.rmse_change_95_m.low, row.rmse_change_95_m.high};
  document["seconds"] = row.seconds;
}

std::string table_csv(const std::vector<TableRow>& table) {
  std::string text = "suite";
  for (const Figure& figure : kFigures)
    text.append(",").append(figure.name).append(figure.is_length ? "_cm" : "");
  for (const TableRow& row : table) {
    text.append("\n").append(csv_field(row.suite));
    for (const Figure& figure : kFigures) text.append(",").append(field_of(figure, row));
  }
  return text + "\n";
}

}  // namespace plotscan::farmbench
