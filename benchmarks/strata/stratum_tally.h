// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>

#include "score/height_score.h"
#include "score/within_farms.h"
#include "strata/measured_field.h"

namespace plotscan::strata {

// The heights that a stratum's row shows; its numbers on flags and intervals count all heights.
inline constexpr std::array<const char*, 4> kShownHeights = {"mean", "p95", "max", "canopy_p95"};

// One height, against the truth that it is named after.
struct HeightTally {
  score::HeightScore score;   // over the plots of all farms
  score::WithinFarms within;  // a farm at a time
};

// All farms of a stratum, or all fields of a kind without plots.
struct StratumTally {
  std::string stratum;
  std::size_t farms = 0;
  std::size_t failures = 0;  // farms on which the estimator gave up
  score::BoxScore boxes;
  std::map<std::string, HeightTally> heights = {};
  std::string worst_height = {};     // the one with the most large errors without a flag
  double worst_unflagged_share = 0;  // of its plots; NaN without heights
  double coverage95 = 0;             // of all heights' intervals together
  double box_coverage95 = 0;         // of the boxes' centres and sides together
  double seconds_per_million_points = 0;
};

// `fields`: of one stratum.
StratumTally tally(const std::string& stratum, std::span<const MeasuredField> fields);

// Area under the ROC curve: the chance that a true plot's confidence is above a false one's, equal
// ones counting half (Mann and Whitney 1947). NaN without plots of both kinds.
double confidence_auc(std::span<const MeasuredField> fields);

}  // namespace plotscan::strata
