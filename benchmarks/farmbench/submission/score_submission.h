// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "farmbench/entries.h"
#include "farmbench/results_table.h"
#include "farmbench/suite_choice.h"

namespace plotscan::farmbench {

struct ScoreSubmissionOptions {
  std::filesystem::path submission;  // a folder
  SuiteChoice suite;
  // Results folder that the scores are added to; made where there is none.
  std::optional<std::filesystem::path> output = std::nullopt;
  int threads = 1;
  std::uint64_t seed = 1;  // of the bootstrap
};

struct ScoredSubmission {
  SuiteResult result;  // of the submission alone
  std::vector<TableRow> table;
  std::vector<std::string> missing;  // fields without a file: nothing of them was found
  std::vector<std::string> apart;    // fields all of whose plots lie apart from the true ones
  // What looks wrong (score::unit_hint), and in which fields.
  std::map<std::string, std::vector<std::string>> hints;
};

// Makes the suite's farms again, without flying them, scores the submission as run_farm scores a
// method, and adds it to the results folder's results.json, tables and report. Throws InputError,
// before anything is written, with all errors of the submission, and if it was made for other farms
// or the folder holds results of other farms.
ScoredSubmission score_submission(const ScoreSubmissionOptions& options,
                                  const ProgressReport& progress = {});

}  // namespace plotscan::farmbench
