// SPDX-License-Identifier: Apache-2.0
#include "plotscan/score.h"

#include "boundary/field_estimate.h"
#include "boundary/guarded.h"
#include "core/angle.h"
#include "core/json_text.h"
#include "score/run.h"
#include "score/score_files.h"

namespace plotscan {
namespace {

Scores outer(const score::Scores& scores) {
  const score::BoxScore& boxes = scores.boxes;
  Scores made{.plots = boxes.plots,
              .found = boxes.found,
              .missed = boxes.missed,
              .extra = boxes.extra,
              .iou_mean = boxes.iou_mean,
              .center_rmse_m = boxes.center_rmse_m,
              .heading_rmse_deg = degrees(boxes.heading_rmse_rad),
              .heights = {},
              .notes = scores.notes};
  for (const score::HeightScore& height : scores.heights) {
    made.heights.push_back({.height = height.height,
                            .truth = height.truth,
                            .plots = height.plots,
                            .rmse_m = height.rmse_m,
                            .bias_m = height.bias_m,
                            .mae_m = height.mae_m,
                            .r2 = height.r2,
                            .coverage95 = height.coverage95});
  }
  made.json = json_lines(score::to_json(scores));
  return made;
}

score::ScoreOptions inner(double min_iou, const std::string& id) {
  score::ScoreOptions options{.min_iou = min_iou};
  if (!id.empty()) options.id = id;
  return options;
}

}  // namespace

Scores score_estimate(const std::filesystem::path& estimate, const std::filesystem::path& truth,
                      double min_iou, const std::string& id) {
  return boundary::guarded([&] {
    return outer(score::run(
        {.estimate = estimate, .truth = truth, .output = {}, .score = inner(min_iou, id)}));
  });
}

Scores score_estimate(const FieldEstimate& estimate, const std::filesystem::path& truth,
                      double min_iou, const std::string& id) {
  return boundary::guarded([&] {
    return outer(score::score_against(truth, boundary::inner(estimate), inner(min_iou, id)));
  });
}

}  // namespace plotscan
