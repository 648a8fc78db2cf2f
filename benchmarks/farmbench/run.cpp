// SPDX-License-Identifier: Apache-2.0
#include "farmbench/run.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include <unistd.h>

#include "core/error.h"
#include "core/format.h"
#include "core/json_text.h"
#include "core/manifest.h"
#include "core/output_folder.h"
#include "core/temporary_path.h"
#include "farmbench/entries.h"
#include "farmbench/internal/farm_queue.h"
#include "farmbench/internal/farm_view.h"
#include "farmbench/internal/method_rows.h"
#include "farmbench/internal/run_farm.h"
#include "farmbench/reports.h"
#include "farmbench/suite_choice.h"
#include "farmbench/text_file.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr const char* kCommand = "farmbench run";

// One farm of the suite and where its result lies.
struct Task {
  const SuiteCase& suite_case;
  std::uint64_t seed;
  std::string name;  // "flat-1"
  json made_from;
  bool viewed = false;  // the report shows this farm
  std::optional<FarmResult> result = std::nullopt;
};

void require_sound(const RunOptions& options) {
  if (options.jobs < 1 || options.jobs > 1024)
    throw InputError("the number of jobs is " + std::to_string(options.jobs) + "; it is 1 to 1024");
  require_own_folder(options.output, kCommand);
}

// Puts these in place of the suite's methods: Plotscan's, and programs that the suite names.
void take_methods(Suite& suite, const std::vector<std::string>& names) {
  std::vector<std::string> own;
  for (const std::string& name : names) {
    if (std::ranges::find(suite.commands, name, &CommandMethod::name) == suite.commands.end())
      own.push_back(name);
    else if (std::ranges::count(names, name) > 1)
      throw InputError("the method \"" + name + "\" is named twice");
  }
  require_known_methods(own);
  suite.methods = names;
}

// The suite with the methods that the options put in place of its own, or beside them.
Suite suite_of(const RunOptions& options) {
  Suite suite =
      chosen_suite({.file = options.suite, .seeds = options.seeds, .secret = options.secret});
  if (!options.methods.empty()) take_methods(suite, options.methods);
  for (const std::string& entered : options.entered) {
    suite.commands.push_back(command_method(entered, options.suite));
    suite.methods.push_back(suite.commands.back().name);
    if (std::ranges::count(suite.methods, suite.methods.back()) > 1)
      throw InputError("the method \"" + suite.methods.back() + "\" is named twice");
  }
  return suite;
}

fs::path result_file(const RunOptions& options, const Task& task) {
  return options.output / "farms" / (task.name + ".json");
}

fs::path times_file(const fs::path& output, const std::string& farm) {
  return output / "times" / (farm + ".json");
}

std::optional<fs::path> view_file(const RunOptions& options, const Task& task) {
  if (!task.viewed) return std::nullopt;
  return farm_view_file(options.output, task.suite_case.name, task.seed);
}

void read_times(const fs::path& output, const std::string& farm, FarmResult& result) {
  const fs::path file = times_file(output, farm);
  if (fs::exists(file)) set_times(result, json::parse(read_json_text(file)));
}

// The farm's result where there is one made from the same; a broken file is as good as none.
std::optional<FarmResult> earlier_result(const RunOptions& options, const Task& task) {
  const fs::path file = result_file(options, task);
  const auto view = view_file(options, task);
  if (!fs::exists(file) || (view && !fs::exists(*view))) return std::nullopt;
  try {
    FarmResult result = farm_result_from_json(json::parse(read_json_text(file)));
    read_times(options.output, task.name, result);
    if (result.made_from == task.made_from) return result;
  } catch (const json::exception&) {
    return std::nullopt;
  }
  return std::nullopt;
}

std::vector<Task> plan(const Suite& suite, const RunOptions& options) {
  std::vector<Task> tasks;
  for (const SuiteCase& suite_case : suite.cases) {
    for (const std::uint64_t seed : suite.seeds) {
      tasks.push_back({.suite_case = suite_case,
                       .seed = seed,
                       .name = suite_case.name + "-" + std::to_string(seed),
                       .made_from = made_from(suite, suite_case, seed, options.build),
                       .viewed = !suite.sweep && seed == suite.seeds.front()});
      if (options.force) continue;
      tasks.back().result = earlier_result(options, tasks.back());
    }
  }
  return tasks;
}

fs::path kept_clouds(const RunOptions& options, const Task& task) {
  return options.output / "clouds" / task.name;
}

// Before hours of work: what stands where a farm's clouds go is an earlier run's.
void require_places(const RunOptions& options, const std::vector<Task>& tasks) {
  if (!options.keep_clouds) return;
  for (const Task& task : tasks)
    if (!task.result) require_replaceable_folder(kept_clouds(options, task), kCommand);
}

void keep_clouds(const fs::path& folder, const fs::path& kept, std::uint64_t seed) {
  write_manifest(folder, {.command = kCommand, .seed = seed});
  require_replaceable_folder(kept, kCommand);
  fs::create_directories(kept.parent_path());
  fs::remove_all(kept);
  fs::rename(folder, kept);
}

void run_task(Task& task, const Suite& suite, const RunOptions& options, const fs::path& work,
              int threads, const ProgressReport& progress) {
  const fs::path folder = work / task.name;
  fs::create_directories(folder);
  FarmResult result = run_farm({.suite = suite,
                                .suite_case = task.suite_case,
                                .seed = task.seed,
                                .folder = folder,
                                .threads = threads,
                                .view = view_file(options, task)},
                               progress);
  result.made_from = task.made_from;
  // The result last: it is what a later run looks for.
  write_text(times_file(options.output, task.name), times_of(result).dump(1) + "\n");
  write_text(result_file(options, task), to_json(result).dump(1) + "\n");
  task.result = std::move(result);
  if (options.keep_clouds) keep_clouds(folder, kept_clouds(options, task), task.seed);
  fs::remove_all(folder);
}

void run_tasks(std::vector<Task>& tasks, const Suite& suite, const RunOptions& options,
               const ProgressReport& progress, const FarmReport& finished) {
  std::vector<Task*> open;
  for (Task& task : tasks) {
    if (!task.result) open.push_back(&task);
  }
  const TemporaryPath work(options.output / (".work-" + std::to_string(getpid())));
  const int threads = std::max(1, options.threads / options.jobs);
  std::mutex report_mutex;
  run_queue(open.size(), options.jobs, progress, [&](std::size_t i, const ProgressReport& own) {
    const auto start = std::chrono::steady_clock::now();
    try {
      run_task(*open[i], suite, options, work.path(), threads, own);
    } catch (const InputError& error) {
      throw InputError(options.suite, "case " + open[i]->suite_case.name + ", seed " +
                                          std::to_string(open[i]->seed) + ": " + error.what());
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const std::lock_guard lock(report_mutex);
    if (finished) finished(*open[i]->result, took.count());
  });
}

// A results folder that a run makes: it goes again where the run ends before its first farm.
class NewFolder {
 public:
  explicit NewFolder(fs::path folder) : folder_(std::move(folder)), is_new_(!fs::exists(folder_)) {}
  ~NewFolder() {
    std::error_code ignored;
    if (is_new_ && fs::is_empty(folder_ / "farms", ignored)) fs::remove_all(folder_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  void keep() { is_new_ = false; }

 private:
  fs::path folder_;
  bool is_new_;
};

// From its start a run's folder says whose it is, so that no other folder is ever taken for it.
void write_run_manifest(const RunOptions& options, const std::vector<Task>& tasks, bool finished) {
  write_manifest(options.output, {.command = kCommand,
                                  .seed = options.seed,
                                  .inputs = {options.suite},
                                  .results = {{"farms", tasks.size()}, {"finished", finished}}});
}

}  // namespace

RunSummary run(const RunOptions& options, const ProgressReport& progress,
               const FarmReport& finished) {
  require_sound(options);
  const Suite suite = suite_of(options);
  std::vector<Task> tasks = plan(suite, options);
  const auto resumed =
      std::ranges::count_if(tasks, [](const Task& task) { return task.result.has_value(); });
  require_places(options, tasks);
  NewFolder folder(options.output);
  for (const char* part : {"farms", "times", "views"})
    fs::create_directories(options.output / part);
  write_run_manifest(options, tasks, false);
  run_tasks(tasks, suite, options, progress, finished);
  std::vector<FarmResult> farms;
  farms.reserve(tasks.size());
  for (Task& task : tasks) farms.push_back(std::move(*task.result));
  RunSummary summary{.result = result_of(suite, std::move(farms)),
                     .table = {},
                     .resumed = static_cast<std::size_t>(resumed)};
  add_entries(options.output, summary.result);
  summary.table = make_table(summary.result, options.seed);
  folder.keep();
  write_text(options.output / "results.json", to_json(summary.result).dump(1) + "\n");
  write_reports(options.output, summary.result, summary.table);
  write_run_manifest(options, tasks, true);
  return summary;
}

SuiteResult read_results(const fs::path& output) {
  const fs::path file = output / "results.json";
  const std::string text = read_json_text(file);
  try {
    const json document = json::parse(text);
    require_known_format(document, file);
    SuiteResult result = suite_result_from_json(document);
    require_methods(result);
    for (FarmResult& farm : result.farms)
      read_times(output, farm.case_name + "-" + std::to_string(farm.seed), farm);
    return result;
  } catch (const json::exception& error) {
    throw InputError(file, std::string("not the results of farmbench run: ") + error.what());
  } catch (const InputError& error) {
    throw InputError(file, error.what());
  }
}

RunSummary report(const fs::path& output, std::uint64_t seed) {
  RunSummary summary{.result = read_results(output), .table = {}};
  summary.resumed = summary.result.farms.size();
  try {
    summary.table = make_table(summary.result, seed);
  } catch (const std::logic_error& error) {  // what make_table takes for granted was edited away
    throw InputError(output / "results.json", std::string("its parts do not fit together (") +
                                                  error.what() + "); farmbench run writes it anew");
  }
  write_reports(output, summary.result, summary.table);
  return summary;
}

}  // namespace plotscan::farmbench
