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
  std::filesystem::path truth;     // a farm folder, or a GeoJSON file of plots with heights
  std::optional<std::filesystem::path> output = {};  // folder to write; else nothing is written
  bool replace = false;                              // an output folder that exists
  ScoreOptions score = {};
};

struct Scores {
  FieldScore field;
  BoxScore boxes;
  std::vector<HeightScore> heights;
  std::vector<std::string> notes = {};  // why there is less than was asked for, a sentence each
};

nlohmann::json to_json(const Scores& scores);

// Scores an estimate of a field. Throws InputError as match_plots does.
Scores score(const std::vector<TruePlot>& truth, const estimate::Estimate& estimate,
             const ScoreOptions& options);

// Scores the estimate; writes scores.json, plots.csv and manifest.json (docs/benchmark.md) where an
// output is asked for. Throws InputError on bad input; nothing is left behind then.
Scores run(const RunOptions& options);

}  // namespace plotscan::score
