// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "core/angle.h"
#include "core/column_text.h"
#include "core/list_of.h"
#include "core/plot_id.h"
#include "score/run.h"

namespace plotscan {
namespace {

// The plots of a table, which are found by their ids.
void say_table(const Program& program, const score::Scores& scores) {
  const score::TableMatch& table = *scores.table;
  const std::size_t found = scores.boxes.found;
  program.say("plots    {} of {} measured plots are in the estimate, by {}", found,
              found + table.not_found.size(), table.id_column);
  if (table.not_found.empty()) return;
  program.say("         not in it: " + joined(table.not_found));
}

void say_boxes(const Program& program, const score::BoxScore& boxes) {
  program.say("plots    {} of {} found, {} missed, {} extra", boxes.found, boxes.plots,
              boxes.missed, boxes.extra);
  if (boxes.found == 0) return;
  program.say(
      "boxes    IoU mean {:.3f}, median {:.3f}, least {:.3f}; centre {:.3f} m rms, "
      "heading {:.2f} deg rms",
      boxes.iou_mean, boxes.iou_median, boxes.iou_min, boxes.center_rmse_m,
      degrees(boxes.heading_rmse_rad));
}

void say_errors(const Program& program, const std::vector<score::HeightScore>& heights) {
  if (heights.empty()) return;
  program.say("{:12} {:15} {:>5} {:>7} {:>7} {:>7} {:>7} {:>7} {:>8} {:>5}", "height", "truth",
              "plots", "without", "RMSE", "bias", "MAE", "SE", "R2", "r^2");
  for (const score::HeightScore& height : heights) {
    program.say("{:12} {:15} {:5} {:7} {} {} {} {} {} {}", height.height, height.truth,
                height.plots, height.without, column_text(100 * height.rmse_m, 7),
                column_text(100 * height.bias_m, 7, true), column_text(100 * height.mae_m, 7),
                column_text(100 * height.standard_error_m, 7), column_text(height.r2, 8),
                column_text(height.correlation2, 5));
  }
}

// What the estimate says of its own errors; nothing where it says nothing.
void say_trust(const Program& program, const std::vector<score::HeightScore>& heights) {
  std::vector<std::string> lines;
  for (const score::HeightScore& height : heights) {
    if (std::isnan(height.coverage95)) continue;
    lines.push_back(fmt::format("{:12} {:15} {:7.1f} % {:9} {:16} ({:.2f} %)", height.height,
                                height.truth, 100 * height.coverage95, height.flagged,
                                height.large_unflagged, 100 * height.large_unflagged_share));
  }
  if (lines.empty()) return;
  program.say("");
  program.say("{:12} {:15} {:>9} {:>9} {:>16}", "height", "truth", "in 95 %", "flagged",
              "over 5 cm, none");
  for (const std::string& line : lines) program.say(line);
  program.say(
      "in 95 %: truths inside the estimate's own intervals; over 5 cm, none: plots in error by "
      "more, unflagged");
}

// Each truth beside the height that is named after it; with -v beside all.
std::vector<score::HeightScore> shown_heights(const Program& program,
                                              const std::vector<score::HeightScore>& scores,
                                              const score::FieldScore& field) {
  if (program.common().verbosity > 0) return scores;
  const std::set<std::string> heights = score::estimated_heights(field);
  return those_of(scores, [&](const score::HeightScore& score) {
    return score::heights_beside(score.truth, heights).contains(score.height);
  });
}

void say_heights(const Program& program, const score::Scores& scores,
                 const std::vector<score::HeightScore>& shown) {
  program.say("");
  say_errors(program, shown);
  for (const score::TrialScore& trial : scores.trials) {
    program.say("");
    program.say("trial {}: {} of {} plots found", trial.trial, trial.found, trial.plots);
    say_errors(program, shown_heights(program, trial.heights, scores.field));
  }
  program.say(
      "RMSE, bias (estimate minus truth), MAE and SE (of the bias) in cm, over the plots "
      "found");
  say_trust(program, shown);
}

void say_scores(const Program& program, const score::Scores& scores) {
  if (scores.table) {
    say_table(program, scores);
  } else {
    say_boxes(program, scores.boxes);
  }
  for (const std::string& note : scores.notes) program.announce("note: " + note);
  if (scores.heights.empty()) return;
  const std::vector<score::HeightScore> shown =
      shown_heights(program, scores.heights, scores.field);
  say_heights(program, scores, shown);
  if (shown.size() < scores.heights.size())
    program.say("Every height against every truth: -v, or scores.json (-o FOLDER)");
}

void score_given(const Program& program, const score::RunOptions& options) {
  const score::Scores scores = score::run(options);
  say_scores(program, scores);
  if (options.output) program.say("written to " + options.output->string());
  program.result(score::to_json(scores));
}

}  // namespace

void declare_score(Program& program) {
  const auto shared = std::make_shared<score::RunOptions>();
  score::RunOptions& options = *shared;
  CLI::App& score = program.command("score", "Compare an estimate with the truth.",
                                    [&program, shared] { score_given(program, *shared); });
  score
      .add_option(
          "EST", options.estimate,
          "estimate folder, or a GeoJSON file of plots with numbers height_<name>_m, metres")
      ->required();
  score
      .add_option("--truth", options.truth,
                  "farm folder, a GeoJSON file of plots with numbers height_<name>_m, metres, or a "
                  "table (.csv) of heights that were measured in the field: ids, and columns such "
                  "as height_mean_cm")
      ->required();
  score.add_option("--id", options.score.id, kIdOfMeasured);
  score.add_option("-o,--output", options.output,
                   "folder to write scores.json and plots.csv to (default: write nothing)");
  score.add_option("--min-iou", options.score.min_iou,
                   "a plot is found where its box overlaps the true one by at least this "
                   "intersection over union (above 0, at most 1)");
  score.add_flag("--force", options.replace, "replace an existing scores folder");
}

}  // namespace plotscan
