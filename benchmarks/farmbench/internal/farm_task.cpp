// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/farm_task.h"

#include <algorithm>
#include <utility>

#include "core/contains.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/manifest.h"
#include "core/output_file.h"
#include "core/output_folder.h"
#include "core/temporary_path.h"
#include "farmbench/command_method.h"
#include "farmbench/internal/farm_view.h"
#include "farmbench/internal/run_farm.h"
#include "farmbench/methods.h"
#include "farmbench/suite_choice.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

fs::path result_file(const RunOptions& options, const FarmTask& task) {
  return options.output / "farms" / (task.name + ".json");
}

fs::path times_file(const fs::path& output, const std::string& farm) {
  return output / "times" / (farm + ".json");
}

std::optional<fs::path> view_file(const RunOptions& options, const FarmTask& task) {
  if (!task.viewed) return std::nullopt;
  return farm_view_file(options.output, task.name);
}

fs::path kept_clouds(const RunOptions& options, const FarmTask& task) {
  return options.output / "clouds" / task.name;
}

void keep_clouds(const fs::path& folder, const fs::path& kept, const FarmTask& task) {
  write_manifest(
      folder,
      {.command = kRunCommand, .seed = task.seed, .options = {{"made_from", task.made_from}}});
  require_replaceable_folder(kept, kRunCommand);
  fs::create_directories(kept.parent_path());
  fs::remove_all(kept);
  // The place of work may be another disk.
  std::error_code other_disk;
  fs::rename(folder, kept, other_disk);
  if (!other_disk) return;
  const TemporaryPath copy(partial_path(kept));
  fs::copy(folder, copy.path(), fs::copy_options::recursive);
  fs::rename(copy.path(), kept);
}

// Whether the farm's clouds are there, as it is now, or not asked for.
bool has_clouds(const RunOptions& options, const FarmTask& task) {
  if (!options.keep_clouds) return true;
  const fs::path kept = kept_clouds(options, task);
  return fs::exists(kept) && read_manifest(kept).at("options").at("made_from") == task.made_from;
}

void run_in(const fs::path& folder, FarmTask& task, const Suite& suite, const RunOptions& options,
            int threads, const ProgressReport& progress) {
  fs::create_directories(folder);
  FarmResult result = run_farm({.suite = suite,
                                .place = {task.suite_case, task.seed, folder, threads},
                                .view = view_file(options, task)},
                               progress);
  result.made_from = task.made_from;
  // The result last: it is what a later run looks for.
  if (options.keep_clouds) keep_clouds(folder, kept_clouds(options, task), task);
  write_whole_file(times_file(options.output, task.name), json_lines(times_of(result)));
  write_whole_file(result_file(options, task), json_lines(json(result)));
  task.result = std::move(result);
  fs::remove_all(folder);
}

}  // namespace

Suite suite_of(const RunOptions& options) {
  Suite suite =
      chosen_suite({.file = options.suite, .seeds = options.seeds, .secret = options.secret});
  if (!options.methods.empty()) suite.methods.clear();
  for (const std::string& written : options.methods) {
    const std::string& name = suite.methods.emplace_back(method_name(written));
    if (!contains(suite.commands, name, &CommandMethod::name))
      method_named(name);  // throws where it is not known
  }
  for (const std::string& entered : options.entered) {
    suite.commands.push_back(command_method(entered, options.suite));
    suite.methods.push_back(suite.commands.back().name);
  }
  for (const std::string& name : suite.methods)
    if (std::ranges::count(suite.methods, name) > 1)
      throw InputError("the method \"" + name + "\" is named twice");
  return suite;
}

bool is_viewed(const Suite& suite, std::uint64_t seed) {
  return !suite.sweep && seed == suite.seeds.front();
}

FarmTask task_of(const Suite& suite, const SuiteCase& suite_case, std::uint64_t seed,
                 const std::string& build) {
  return {.suite_case = suite_case,
          .seed = seed,
          .name = farm_name(suite_case.name, seed),
          .made_from = made_from(suite, suite_case, seed, build),
          .viewed = is_viewed(suite, seed)};
}

std::vector<FarmTask> farm_tasks(const Suite& suite, const RunOptions& options) {
  std::vector<FarmTask> tasks;
  for (const SuiteCase& suite_case : suite.cases) {
    for (const std::uint64_t seed : suite.seeds) {
      tasks.push_back(task_of(suite, suite_case, seed, options.build));
      if (options.force) continue;
      tasks.back().result = earlier_result(options, tasks.back());
    }
  }
  return tasks;
}

std::optional<FarmResult> earlier_result(const RunOptions& options, const FarmTask& task) {
  const fs::path file = result_file(options, task);
  const auto view = view_file(options, task);
  if (!fs::exists(file) || (view && !fs::exists(*view))) return std::nullopt;
  try {
    FarmResult result = json::parse(read_json_text(file));
    read_times(options.output, result);
    if (result.made_from == task.made_from && has_clouds(options, task)) return result;
  } catch (const json::exception&) {  // it counts as none
  } catch (const InputError&) {
  }
  return std::nullopt;
}

void read_times(const fs::path& output, FarmResult& result) {
  const fs::path file = times_file(output, farm_name(result.case_name, result.seed));
  if (!fs::exists(file)) return;
  try {
    set_times(result, json::parse(read_json_text(file)));
  } catch (const json::exception& error) {
    throw InputError(file, "not the times of a farm ({}); without this file they are not known",
                     json_reason(error));
  }
}

void require_places(const RunOptions& options, const std::vector<FarmTask>& tasks) {
  if (!options.keep_clouds) return;
  for (const FarmTask& task : tasks)
    if (!task.result) require_replaceable_folder(kept_clouds(options, task), kRunCommand);
}

void run_task(FarmTask& task, const Suite& suite, const RunOptions& options, const fs::path& work,
              int threads, const ProgressReport& progress) {
  try {
    run_in(work / task.name, task, suite, options, threads, progress);
  } catch (const InputError& error) {
    throw InputError(options.suite, "case {}, seed {}: {}", task.suite_case.name, task.seed,
                     error.what());
  }
}

void make_result_folders(const fs::path& output) {
  for (const char* part : {"farms", "times", "views"}) fs::create_directories(output / part);
}

}  // namespace plotscan::farmbench
