// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "farmbench/suite_result.h"
#include "score/height_score.h"
#include "score/score.h"
#include "score/within_farms.h"

namespace plotscan::farmbench {

// Ends of a 95 % interval; NaN where there is none.
struct Interval {
  double low = kNaN;
  double high = kNaN;
};

// One case, method and truth over all farms of the case (docs/benchmark.md). What cannot be
// computed is NaN.
struct TableRow {
  std::string suite;
  std::string case_name;
  std::string method;  // MethodHeight::row
  std::string truth;   // "height_max_m"; "" where there are no plots, and no heights then
  bool named = false;  // the height is named after the truth (score::named_truth)
  bool shown = true;   // the height stands beside the truth in reports (score::heights_beside)
  std::size_t farms = 0;
  score::BoxScore boxes = {};
  score::HeightScore height = {};
  Interval rmse_95_m = {};  // bootstrap over farms
  // This RMSE minus that of the suite's baseline on the same farms. NaN where the suite names none.
  double rmse_change_m = kNaN;
  Interval rmse_change_95_m = {};
  score::WithinFarms within = {};  // the error a farm and within it; NaN where nothing was found
  double seconds = 0;              // of the method, median over farms; NaN: not known
};

// All rows: by case, by method, by truth; of a case without plots, one row a method. `seed` draws
// the bootstrap's resamples.
std::vector<TableRow> make_table(const SuiteResult& result, std::uint64_t seed);

// The rows' methods, each once, in their order.
std::vector<std::string> methods_of(const std::vector<TableRow>& rows);

// A row as --json prints it: metres, degrees, null for NaN.
void to_json(nlohmann::json& document, const TableRow& row);

// table.csv (docs/benchmark.md); a field that is NaN is empty.
std::string table_csv(const std::vector<TableRow>& table);

}  // namespace plotscan::farmbench
