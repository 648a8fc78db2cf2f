// SPDX-License-Identifier: Apache-2.0
#include "score/run.h"

#include "core/format_version.h"
#include "core/json_text.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "core/plot_features.h"
#include "core/text_file.h"
#include "estimate/estimate.h"
#include "score/measured_table.h"
#include "score/score_files.h"

namespace plotscan::score {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

void write_scores(const Scores& scores, const RunOptions& options) {
  OutputFolder folder(*options.output, options.replace, "estimator score",
                      {{options.estimate, options.truth}});
  write_text_file(folder.path() / "scores.json", json_lines(to_json(scores)));
  write_plot_table(folder.path() / "plots.csv", scores.field);
  write_manifest(folder.path(),
                 {.command = "estimator score",
                  .options = {{"min_iou", options.score.min_iou}},
                  .inputs = {estimated_map_of(options.estimate), plot_map_of(options.truth)},
                  .results = {{"boxes", to_json(scores)["boxes"]}}});
  folder.commit();
}

}  // namespace

json to_json(const Scores& scores) {
  json document = {{"format", kFormat},
                   {"boxes", scores.table ? json(nullptr) : json(scores.boxes)},
                   {"heights", scores.heights},
                   {"field", scores.field}};
  if (!scores.trials.empty()) document["trials"] = scores.trials;
  if (!scores.notes.empty()) document["notes"] = scores.notes;
  if (const auto& table = scores.table) {
    document["table"] = {{"id_column", table->id_column}, {"not_found", table->not_found}};
  }
  return document;
}

Scores score(const std::vector<TruePlot>& truth, const estimate::Estimate& estimate,
             const ScoreOptions& options) {
  Scores scores;
  scores.field = score_field(truth, estimate, options);
  scores.boxes = score_boxes({&scores.field, 1});
  scores.heights = score_heights(scores.field);
  scores.trials = score_trials(scores.field);
  if (const std::string& why = estimate.diagnostics.why_no_plots; !why.empty())
    scores.notes.push_back("The estimate has no plots: " + why);
  if (const std::string note = apart_note(truth, estimate); !note.empty())
    scores.notes.push_back(note);
  if (const std::string hint = unit_hint(scores.field); !hint.empty()) scores.notes.push_back(hint);
  if (scores.boxes.found > 0 && scores.heights.empty()) {
    scores.notes.push_back(std::string("No height is compared: no ") +
                           (true_heights(scores.field).empty() ? "true" : "found") +
                           " plot has one, a number in a property height_<name>_m or "
                           "canopy_<name>_m.");
  }
  return scores;
}

Scores score_against(const fs::path& truth, const estimate::Estimate& estimate,
                     const ScoreOptions& options) {
  if (!is_measured_table(truth, options.id))
    return score(read_truth(truth, estimate.crs), estimate, options);
  const MeasuredPlots measured = read_measured(truth, estimate, options.id);
  Scores scores = score(measured.plots, estimate, options);
  scores.table = {.id_column = measured.id_column, .not_found = measured.not_found};
  return scores;
}

Scores run(const RunOptions& options) {
  Scores scores = score_against(
      options.truth, read_estimate_beside(options.truth, options.estimate), options.score);
  if (options.output) write_scores(scores, options);
  return scores;
}

}  // namespace plotscan::score
