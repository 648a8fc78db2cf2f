// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "score/height_score.h"
#include "score/score.h"

namespace plotscan::score {

// One scoring, from files to scores.
struct RunOptions {
  std::filesystem::path estimate;  // an estimate folder, or a GeoJSON file of plots with heights
  std::filesystem::path truth;     // a farm folder, or a GeoJSON file or a table of plots' heights
  std::optional<std::filesystem::path> output = {};  // folder to write; else nothing is written
  bool replace = false;                              // an output folder that exists
  ScoreOptions score = {};
};

// How a table of measured heights meets the estimate.
struct TableMatch {
  std::string id_column;
  std::vector<PlotId> not_found = {};  // in the table, and not in the estimate
};

struct Scores {
  FieldScore field;
  BoxScore boxes;
  std::vector<HeightScore> heights;
  std::vector<TrialScore> trials = {};  // the same trial by trial, where there are several
  std::vector<std::string> notes = {};  // why there is less than was asked for, a sentence each
  // Where the truth is a table: plots are found by their ids, and boxes say nothing.
  std::optional<TableMatch> table = {};
};

nlohmann::json to_json(const Scores& scores);

// Scores an estimate of a field. Throws InputError as match_plots does.
Scores score(const std::vector<TruePlot>& truth, const estimate::Estimate& estimate,
             const ScoreOptions& options);

// The same against a truth's file or folder (read_truth, read_measured). Throws InputError as these
// do.
Scores score_against(const std::filesystem::path& truth, const estimate::Estimate& estimate,
                     const ScoreOptions& options);

// Scores the estimate; writes scores.json, plots.csv and manifest.json (docs/benchmark.md) where an
// output is asked for. Throws InputError on bad input; nothing is left behind then.
Scores run(const RunOptions& options);

}  // namespace plotscan::score
