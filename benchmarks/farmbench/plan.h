// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/progress.h"
#include "farmbench/run.h"

// Runs a suite without `run`: one command for each farm, in any order, on many machines that share
// the results folder (docs/scale.md).
namespace plotscan::farmbench {

struct PlanSummary {
  std::size_t farms = 0;
  std::size_t changed = 0;  // cases planned for the first time, or otherwise than before
};

// Makes the results folder of a suite before its farms are run: - plan.json: the suite, its file's
// hash, and what the options choose of it; - plan/CASE.json: what the results of the case's farms
// are made from, but for the seed; - tasks.csv: farm, case, seed, viewed (1 where views/FARM.cbor
// is written as well), a row a farm; - manifest.json, as run writes it. Files whose content would
// not change stay untouched, so that newer files made from them need not be made again. The options
// jobs, threads, force and seed have no effect. Throws InputError as run does before its first
// farm.
PlanSummary plan(const RunOptions& options);

struct PlannedFarmOptions {
  int threads = 1;
  std::string build;                                         // of this program
  std::optional<std::filesystem::path> work = std::nullopt;  // a disk of the machine's own
  bool force = false;                                        // run again what has been run
};

struct PlannedFarm {
  FarmResult result;
  bool resumed = false;  // its result was there already
};

// Runs one farm of a planned results folder by its name, "flat-1". The farm and its scan lie in
// `work`, or in the results folder, until its result is written, by the same files as of run. Any
// number of farms may run at a time, on any machines. Throws InputError on a folder without a plan,
// a name that is no farm of it, a plan of another build or of files that have changed since, and as
// run_farm does.
PlannedFarm run_planned(const std::filesystem::path& output, const std::string& farm,
                        const PlannedFarmOptions& options, const ProgressReport& progress = {});

struct MergeOptions {
  std::uint64_t seed = 1;      // of the bootstrap
  std::string build;           // of this program
  bool finished_only = false;  // leave out farms without a result
};

struct MergeSummary {
  RunSummary run;
  std::vector<std::string> missing;  // farms without a result
};

// Writes into a planned results folder what run writes after its last farm. Throws InputError as
// run_planned does, if no farm has a result, and, unless finished_only is set, if any farm has
// none.
MergeSummary merge(const std::filesystem::path& output, const MergeOptions& options);

}  // namespace plotscan::farmbench
