// SPDX-License-Identifier: Apache-2.0
#include "strata/stratum_tally.h"

#include <algorithm>
#include <set>

#include "core/statistics.h"

namespace plotscan::strata {
namespace {

void set_heights(StratumTally& tally, std::span<const score::FieldScore> fields) {
  std::set<std::string> heights;
  for (const score::FieldScore& field : fields) heights.merge(score::estimated_heights(field));
  tally.worst_unflagged_share = kNaN;
  double intervals = 0, covered = 0;
  for (const std::string& height : heights) {
    const score::HeightOnFarms one =
        score::score_on_farms(fields, height, score::named_truth(height));
    intervals += static_cast<double>(one.pooled.trust.intervals);
    covered += static_cast<double>(one.pooled.trust.covered);
    if (one.score.plots > 0 && !(one.score.large_unflagged_share <= tally.worst_unflagged_share)) {
      tally.worst_unflagged_share = one.score.large_unflagged_share;
      tally.worst_height = height;
    }
    tally.heights.emplace(height, HeightTally{one.score, one.within});
  }
  tally.coverage95 = ratio(covered, intervals);
}

}  // namespace

StratumTally tally(const std::string& stratum, std::span<const MeasuredField> fields) {
  StratumTally tally{.stratum = stratum, .farms = fields.size(), .boxes = {}};
  std::vector<score::FieldScore> scores;
  double seconds = 0, points = 0, box_figures = 0, box_figures_inside = 0;
  for (const MeasuredField& field : fields) {
    scores.push_back(field.score);
    box_figures += static_cast<double>(field.box_figures);
    box_figures_inside += static_cast<double>(field.box_figures_inside);
    tally.failures += !field.failure.empty();
    if (!field.failure.empty()) continue;
    seconds += field.seconds;
    points += static_cast<double>(field.points);
  }
  tally.boxes = score::score_boxes(scores);
  tally.box_coverage95 = ratio(box_figures_inside, box_figures);
  tally.seconds_per_million_points = ratio(1e6 * seconds, points);
  set_heights(tally, scores);
  return tally;
}

double confidence_auc(std::span<const MeasuredField> fields) {
  std::vector<double> truths, falses;
  for (const MeasuredField& field : fields) {
    truths.insert(truths.end(), field.true_confidences.begin(), field.true_confidences.end());
    falses.insert(falses.end(), field.false_confidences.begin(), field.false_confidences.end());
  }
  std::ranges::sort(falses);
  double above = 0;
  for (const double confidence : truths) {
    const auto low = std::ranges::lower_bound(falses, confidence);
    const auto high = std::ranges::upper_bound(falses, confidence);
    above += static_cast<double>(low - falses.begin()) + static_cast<double>(high - low) / 2;
  }
  return ratio(above, static_cast<double>(truths.size()) * static_cast<double>(falses.size()));
}

}  // namespace plotscan::strata
