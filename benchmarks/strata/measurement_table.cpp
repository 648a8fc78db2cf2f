// SPDX-License-Identifier: Apache-2.0
#include "strata/measurement_table.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/number_text.h"
#include "score/score_files.h"

namespace plotscan::strata {
namespace {

using nlohmann::json;

// The fields' strata in their order, each tallied.
std::vector<StratumTally> tally_strata(std::span<const MeasuredField> fields) {
  std::vector<StratumTally> tallies;
  for (std::size_t first = 0; first < fields.size();) {
    std::size_t end = first;
    while (end < fields.size() && fields[end].stratum == fields[first].stratum) ++end;
    tallies.push_back(tally(fields[first].stratum, fields.subspan(first, end - first)));
    first = end;
  }
  return tallies;
}

// RMSE, bias (the worst farm's) in centimetres, r2 within farms.
std::string height_cell(const StratumTally& tally, const char* height) {
  const auto found = tally.heights.find(height);
  if (found == tally.heights.end()) return "-";
  const HeightTally& one = found->second;
  return cell("{:.1f}", 100 * one.score.rmse_m) + " " + cell("{:+.1f}", 100 * one.score.bias_m) +
         " (" + cell("{:+.1f}", 100 * one.within.worst_bias_m) + ") " +
         cell("{:.2f}", one.within.r2);
}

std::string stratum_line(const StratumTally& tally) {
  std::string line = fmt::format(
      "{:10} {:5} {:5} {:>6} {:>6} {:>5} {:>5}", tally.stratum, tally.farms, tally.boxes.plots,
      cell("{:.4f}", tally.boxes.recall), cell("{:.4f}", tally.boxes.precision),
      cell("{:.3f}", tally.boxes.iou_mean), cell("{:.1f}", 100 * tally.boxes.center_rmse_m));
  for (const char* height : kShownHeights)
    line += fmt::format("  {:21}", height_cell(tally, height));
  const std::string unflagged =
      cell("{:.1f}", 100 * tally.worst_unflagged_share) + " " + tally.worst_height;
  return line + fmt::format("  {:15} {:>6} {:>6} {:>6}", unflagged,
                            cell("{:.1f}", 100 * tally.coverage95),
                            cell("{:.1f}", 100 * tally.box_coverage95),
                            cell("{:.2f}", tally.seconds_per_million_points));
}

std::vector<std::string> farm_lines(std::span<const MeasuredField> farms) {
  std::string heading = fmt::format("{:10} {:>5} {:>5} {:>6} {:>6} {:>5} {:>5}", "stratum", "farms",
                                    "plots", "recall", "prec.", "IoU", "centre");
  for (const char* height : kShownHeights) heading += fmt::format("  {:21}", height);
  std::vector<std::string> lines = {
      "Centre and heights in cm; of a height: RMSE bias (the worst farm's) r2 within farms. Over "
      "5: "
      "% of the plots with an error over 5 cm",
      "and no flag, of the worst of all heights; in 95: % of truths in the 95 % intervals of all "
      "heights; box 95: of the boxes' centres and sides; s/M: seconds per million points",
      heading + fmt::format("  {:15} {:>6} {:>6} {:>6}", "over 5", "in 95", "box 95", "s/M")};
  for (const StratumTally& one : tally_strata(farms)) lines.push_back(stratum_line(one));
  return lines;
}

std::vector<std::string> empty_lines(std::span<const MeasuredField> fields) {
  std::vector<std::string> lines = {
      "", fmt::format("{:10} {:>6} {:>15} {:>14} {:>6}", "no plots", "fields", "plots invented",
                      "fields with", "s/M")};
  for (const StratumTally& one : tally_strata(fields)) {
    const auto some = std::ranges::count_if(fields, [&](const MeasuredField& field) {
      return field.stratum == one.stratum && !field.score.extra.empty();
    });
    lines.push_back(fmt::format("{:10} {:6} {:15} {:14} {:>6}", one.stratum, one.farms,
                                one.boxes.extra, some,
                                cell("{:.2f}", one.seconds_per_million_points)));
  }
  return lines;
}

std::vector<MeasuredField> all_fields(const Measurement& measurement) {
  std::vector<MeasuredField> all = measurement.farms;
  all.insert(all.end(), measurement.empty_fields.begin(), measurement.empty_fields.end());
  return all;
}

}  // namespace

void to_json(json& document, const HeightTally& tally) {
  document = tally.score;
  document["farm_bias_m"] = tally.within.farm_bias_m;
  document["worst_farm_bias_m"] = tally.within.worst_bias_m;
  document["within_m"] = tally.within.within_m;
  document["r2_within"] = tally.within.r2;
  document["rho_within"] = tally.within.rho;
}

void to_json(json& document, const StratumTally& tally) {
  document = {{"stratum", tally.stratum},
              {"farms", tally.farms},
              {"failures", tally.failures},
              {"boxes", tally.boxes},
              {"heights", tally.heights},
              {"worst_height", tally.worst_height},
              {"over_5cm_unflagged_share", tally.worst_unflagged_share},
              {"coverage95", tally.coverage95},
              {"box_coverage95", tally.box_coverage95},
              {"seconds_per_million_points", tally.seconds_per_million_points}};
}

void to_json(json& document, const MeasuredField& field) {
  document = {{"stratum", field.stratum},
              {"index", field.index},
              {"points", field.points},
              {"seconds", field.seconds},
              {"failure", field.failure},
              {"true_confidences", field.true_confidences},
              {"false_confidences", field.false_confidences},
              {"score", field.score}};
}

std::vector<std::string> table_lines(const Measurement& measurement) {
  std::vector<std::string> lines;
  if (!measurement.farms.empty()) lines = farm_lines(measurement.farms);
  if (!measurement.empty_fields.empty()) {
    const std::vector<std::string> more = empty_lines(measurement.empty_fields);
    lines.insert(lines.end(), more.begin(), more.end());
  }
  const double auc = confidence_auc(all_fields(measurement));
  lines.push_back("");
  lines.push_back("AUC of confidence, false against true plots: " + cell("{:.3f}", auc));
  return lines;
}

std::string field_line(const MeasuredField& field) {
  const score::BoxScore boxes = score::score_boxes({&field.score, 1});
  std::string line = fmt::format("{}-{}: {} plots, {} found, {} extra", field.stratum, field.index,
                                 boxes.plots, boxes.found, boxes.extra);
  if (boxes.found > 0) line += ", IoU " + cell("{:.3f}", boxes.iou_mean);
  for (const char* height : kShownHeights) {
    const std::string truth = score::named_truth(height);
    const score::HeightPairs pairs = score::height_pairs(field.score, height, truth);
    if (pairs.truths_m.empty()) continue;
    line += fmt::format(", {} {:+.1f} cm", height,
                        100 * score::score_height(height, truth, pairs).bias_m);
  }
  if (!field.failure.empty()) line += "; gave up: " + field.failure;
  return line;
}

json to_json(const Measurement& measurement) {
  return {{"strata", tally_strata(measurement.farms)},
          {"fields_without_plots", tally_strata(measurement.empty_fields)},
          {"confidence_auc", confidence_auc(all_fields(measurement))},
          {"farms", measurement.farms},
          {"empty_fields", measurement.empty_fields}};
}

}  // namespace plotscan::strata
