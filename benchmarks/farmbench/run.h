// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "farmbench/results_table.h"
#include "farmbench/suite_result.h"

namespace plotscan::farmbench {

struct RunOptions {
  std::filesystem::path suite;              // the YAML file
  std::filesystem::path output;             // results folder
  int jobs = 1;                             // farms at a time
  int threads = 1;                          // of all jobs together
  bool keep_clouds = false;                 // keep each farm and its scan in output/clouds
  bool force = false;                       // run again what has been run
  std::optional<int> seeds = std::nullopt;  // this many from the suite's first one
  // For a blind contest: the file that seeds are drawn from (suite_choice.h).
  std::optional<std::filesystem::path> secret = std::nullopt;
  std::vector<std::string> methods = {};  // these in place of the suite's
  std::vector<std::string> entered = {};  // "NAME=COMMAND": programs beside them
  std::string build;       // identifies the program, so that no other program's farms are kept
  std::uint64_t seed = 1;  // of the bootstrap
};

struct RunSummary {
  SuiteResult result;
  std::vector<TableRow> table;
  std::size_t resumed = 0;  // farms whose results were there already
};

// Called for each farm that has been run, with the time it took, from one thread at a time.
using FarmReport = std::function<void(const FarmResult& farm, double seconds)>;

// The command named in a results folder's manifest, whichever of farmbench's commands wrote it.
inline constexpr const char* kRunCommand = "farmbench run";

// Runs the suite and writes output/farms/CASE-SEED.json and times/CASE-SEED.json farm by farm, of
// each case's first farm views/CASE-SEED.cbor, then the reports of write_reports and manifest.json.
// A farm is not run again when its file is there and was made from the same (made_from). Nothing
// but the times depends on jobs and threads. If no farm was finished, an output folder that did not
// exist before is removed. Throws InputError on a bad suite, options out of range, an output that
// is no results folder, and as run_farm does.
RunSummary run(const RunOptions& options, const ProgressReport& progress = {},
               const FarmReport& finished = {});

// Reads output/results.json and output/times. Throws InputError where these do not fit together.
SuiteResult read_results(const std::filesystem::path& output);

// Makes the reports again from output/results.json and output/times. Throws InputError where these
// do not fit together.
RunSummary report(const std::filesystem::path& output, std::uint64_t seed);

}  // namespace plotscan::farmbench
