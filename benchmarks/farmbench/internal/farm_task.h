// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/progress.h"
#include "farmbench/farm_result.h"
#include "farmbench/run.h"
#include "farmbench/suite.h"

namespace plotscan::farmbench {

// One farm of a suite and what its result is made from.
struct FarmTask {
  const SuiteCase& suite_case;
  std::uint64_t seed = 1;
  std::string name;  // "flat-1"
  nlohmann::json made_from;
  bool viewed = false;  // the report shows this farm
  std::optional<FarmResult> result = std::nullopt;
};

// The suite with the methods that the options put in place of its own, or beside them. Throws
// InputError as chosen_suite does, and on methods that are unknown or named twice.
Suite suite_of(const RunOptions& options);

// Whether the report shows the farms of this seed: each case's first, and none of a sweep.
bool is_viewed(const Suite& suite, std::uint64_t seed);

FarmTask task_of(const Suite& suite, const SuiteCase& suite_case, std::uint64_t seed,
                 const std::string& build);

// Every farm of the suite, which outlives them, by case and seed, with the results that are there
// already unless options.force is set.
std::vector<FarmTask> farm_tasks(const Suite& suite, const RunOptions& options);

// The farm's earlier result, if it was made from the same inputs, and its clouds are there too
// where options.keep_clouds is set; a broken file counts as none.
std::optional<FarmResult> earlier_result(const RunOptions& options, const FarmTask& task);

// Reads the times of output/times into the result, where there are any. Throws InputError on a
// broken file of them.
void read_times(const std::filesystem::path& output, FarmResult& result);

// Throws InputError if the place for a farm's kept clouds holds something not from an earlier run.
void require_places(const RunOptions& options, const std::vector<FarmTask>& tasks);

// Runs the farm in a folder of its own in `work`, which is made where it is not there, and writes
// output/times, output/farms and, of a viewed one, output/views; sets task.result. Throws
// InputError, naming the suite, the case and the seed, as run_farm does.
void run_task(FarmTask& task, const Suite& suite, const RunOptions& options,
              const std::filesystem::path& work, int threads, const ProgressReport& progress);

// The folders that run_task writes into.
void make_result_folders(const std::filesystem::path& output);

// The folder's manifest.json. It is there from the start of a run, so that no other folder can be
// taken for a results folder.
void write_run_manifest(const RunOptions& options, const std::string& suite, std::size_t farms,
                        bool finished);

// Throws InputError where the folder holds the results of another suite.
void require_results_of(const std::filesystem::path& output, const std::string& suite);

// Writes output/results.json, the reports and manifest.json from the farms that have results.
RunSummary write_results(const RunOptions& options, const Suite& suite,
                         std::vector<FarmTask> tasks);

}  // namespace plotscan::farmbench
