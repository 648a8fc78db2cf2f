// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "plotscan/error.h"
#include "plotscan/estimate.h"
#include "plotscan/export.h"

namespace plotscan {

// One estimated height against one true one over the plots that were found; errors are estimate
// minus truth. What cannot be computed is NaN (docs/benchmark.md).
struct HeightScore {
  std::string height;  // "max"
  std::string truth;   // "height_max_m"
  std::size_t plots = 0;
  double rmse_m = 0;
  double bias_m = 0;
  double mae_m = 0;
  double r2 = 0;          // against the line estimate = truth
  double coverage95 = 0;  // share of truths inside the 95 % intervals
};

struct Scores {
  std::size_t plots = 0;  // true ones
  std::size_t found = 0;
  std::size_t missed = 0;
  std::size_t extra = 0;
  double iou_mean = 0;  // of the found plots' boxes; NaN without any, as the next two
  double center_rmse_m = 0;
  double heading_rmse_deg = 0;
  std::vector<HeightScore> heights = {};  // every height against every truth
  std::vector<std::string> notes = {};    // why there is less than was asked for, a sentence each
  std::string json = {};                  // scores.json as the program writes it
};

// What `estimator score` does: an estimate folder, or a GeoJSON file of plots with heights, against
// a farm folder, a GeoJSON file of true ones, or a table of measured heights (docs/benchmark.md). A
// plot is found where the boxes' intersection over union is at least min_iou, over 0 and at most 1;
// for a table, where its id is in the column `id` ("": as docs/benchmark.md says). Throws BadInput
// on bad input.
PLOTSCAN_API Scores score_estimate(const std::filesystem::path& estimate,
                                   const std::filesystem::path& truth, double min_iou = 0.5,
                                   const std::string& id = "");

// The same of an estimate held in memory.
PLOTSCAN_API Scores score_estimate(const FieldEstimate& estimate,
                                   const std::filesystem::path& truth, double min_iou = 0.5,
                                   const std::string& id = "");

}  // namespace plotscan
