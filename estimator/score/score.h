// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/plot_features.h"
#include "estimate/estimate.h"

namespace plotscan::score {

// Which estimated plot is which true one.
struct PlotMatch {
  std::size_t truth = 0;     // index of the true plot
  std::size_t estimate = 0;  // index of the estimated plot
  double iou = 0;
};

struct Matching {
  std::vector<PlotMatch> matches;   // by true plot; one to one
  std::vector<std::size_t> missed;  // true plots without an estimate
  std::vector<std::size_t> extra;   // estimates without a true plot
};

// Errors of one estimated height against one truth, over the matched plots.
struct HeightScore {
  std::string height;            // "raw-p99"
  std::string truth;             // "height_max_m"
  std::vector<double> errors_m;  // estimate minus truth, by matched plot
  std::vector<double> truths_m;
};

}  // namespace plotscan::score
