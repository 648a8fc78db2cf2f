// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "farmbench/suite_result.h"
#include "score/within_farms.h"

namespace plotscan::farmbench {

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
  std::size_t plots = 0;  // true ones
  std::size_t found = 0;
  std::size_t missed = 0;
  std::size_t extra = 0;
  std::size_t without = 0;  // found plots without this height
  double recall = 0;        // found / plots
  double precision = 0;     // found / (found + extra)
  double iou_mean = 0;
  double iou_median = 0;
  double iou_min = 0;
  double center_rmse_m = 0;
  double heading_rmse_rad = 0;
  double rmse_m = 0;
  double rmse_low_m = 0;  // 95 % bootstrap interval over farms
  double rmse_high_m = 0;
  // This RMSE minus that of the suite's baseline on the same farms, and its 95 % interval. NaN
  // where the suite names no baseline.
  double rmse_change_m = kNaN;
  double rmse_change_low_m = kNaN;
  double rmse_change_high_m = kNaN;
  double bias_m = 0;
  double mae_m = 0;
  double r2 = 0;
  score::WithinFarms within = {};  // the error a farm and within it; NaN where nothing was found
  // Share of truths inside the method's own 95 % intervals; NaN for a method without intervals, and
  // where the height is not named after the truth.
  double coverage95 = kNaN;
  std::size_t flagged = 0;              // found plots with this height and a flag
  std::size_t large_unflagged = 0;      // those without, in error by more than score::kLargeError_m
  double large_unflagged_share = kNaN;  // of all with it
  double seconds = 0;                   // of the method, median over farms; NaN: not known
};

// All rows: by case, by method, by truth; of a case without plots, one row a method. `seed` draws
// the bootstrap's resamples.
std::vector<TableRow> make_table(const SuiteResult& result, std::uint64_t seed);

// The rows' methods, each once, in their order.
std::vector<std::string> methods_of(const std::vector<TableRow>& rows);

// A row as --json prints it: metres, degrees, null for NaN.
nlohmann::json to_json(const TableRow& row);

// table.csv (docs/benchmark.md); a field that is NaN is empty.
std::string table_csv(const std::vector<TableRow>& table);

}  // namespace plotscan::farmbench
