// SPDX-License-Identifier: Apache-2.0
#include "farmbench/run.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <utility>

#include <unistd.h>

#include "core/error.h"
#include "core/format_version.h"
#include "core/json_text.h"
#include "core/manifest.h"
#include "core/output_file.h"
#include "core/output_folder.h"
#include "core/stopwatch.h"
#include "core/temporary_path.h"
#include "farmbench/entries.h"
#include "farmbench/internal/farm_queue.h"
#include "farmbench/internal/farm_task.h"
#include "farmbench/internal/method_rows.h"
#include "farmbench/reports.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

// What decides the results, besides the suite's file. The secret itself is left out.
json options_json(const RunOptions& options, const std::string& suite) {
  json document = {{"suite", suite},
                   {"methods", options.methods},
                   {"entered", options.entered},
                   {"secret", options.secret.has_value()}};
  if (options.seeds) document["seeds"] = *options.seeds;
  return document;
}

void require_sound(const RunOptions& options) {
  if (options.jobs < 1 || options.jobs > 1024)
    throw InputError("the number of jobs is " + std::to_string(options.jobs) + "; it is 1 to 1024");
  require_own_folder(options.output, kRunCommand);
}

void run_tasks(std::vector<FarmTask>& tasks, const Suite& suite, const RunOptions& options,
               const ProgressReport& progress, const FarmReport& finished) {
  std::vector<FarmTask*> open;
  for (FarmTask& task : tasks) {
    if (!task.result) open.push_back(&task);
  }
  const TemporaryPath work(options.output / (".work-" + std::to_string(getpid())));
  const int threads = std::max(1, options.threads / options.jobs);
  std::mutex report_mutex;
  run_queue(open.size(), options.jobs, progress, [&](std::size_t i, const ProgressReport& own) {
    const Stopwatch watch;
    run_task(*open[i], suite, options, work.path(), threads, own);
    const std::lock_guard lock(report_mutex);
    if (finished) finished(*open[i]->result, watch.seconds());
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

 private:
  fs::path folder_;
  bool is_new_;
};

}  // namespace

void require_results_of(const fs::path& output, const std::string& suite) {
  if (!fs::exists(output / "manifest.json")) return;
  const json manifest = read_manifest(output);
  const std::string held = manifest.value("options", json::object()).value("suite", suite);
  if (held != suite)
    throw InputError(output,
                     "holds the results of suite {}, and this is suite {}; choose another folder",
                     held, suite);
}

void write_run_manifest(const RunOptions& options, const std::string& suite, std::size_t farms,
                        bool finished) {
  write_manifest(options.output, {.command = kRunCommand,
                                  .seed = options.seed,
                                  .options = options_json(options, suite),
                                  .inputs = {options.suite},
                                  .results = {{"farms", farms}, {"finished", finished}}});
}

RunSummary write_results(const RunOptions& options, const Suite& suite,
                         std::vector<FarmTask> tasks) {
  std::vector<FarmResult> farms;
  farms.reserve(tasks.size());
  for (FarmTask& task : tasks)
    if (task.result) farms.push_back(std::move(*task.result));
  const bool finished = farms.size() == tasks.size();
  RunSummary summary{.result = result_of(suite, std::move(farms)), .table = {}};
  add_entries(options.output, summary.result);
  summary.table = make_table(summary.result, options.seed);
  write_whole_file(options.output / "results.json", json_lines(json(summary.result)));
  write_reports(options.output, summary.result, summary.table);
  write_run_manifest(options, suite.name, tasks.size(), finished);
  return summary;
}

RunSummary run(const RunOptions& options, const ProgressReport& progress,
               const FarmReport& finished) {
  require_sound(options);
  const Suite suite = suite_of(options);
  require_results_of(options.output, suite.name);
  require_entries(options.output, suite.methods);
  std::vector<FarmTask> tasks = farm_tasks(suite, options);
  const auto resumed =
      std::ranges::count_if(tasks, [](const FarmTask& task) { return task.result.has_value(); });
  require_places(options, tasks);
  const NewFolder folder(options.output);
  make_result_folders(options.output);
  write_run_manifest(options, suite.name, tasks.size(), false);
  run_tasks(tasks, suite, options, progress, finished);
  RunSummary summary = write_results(options, suite, std::move(tasks));
  summary.resumed = static_cast<std::size_t>(resumed);
  return summary;
}

SuiteResult read_results(const fs::path& output) {
  const fs::path file = output / "results.json";
  const json document = read_json(file);
  require_known_format(document, file);
  SuiteResult result;
  try {
    document.get_to(result);
    require_methods(result);
    require_whole(result);
  } catch (const json::exception& error) {
    throw InputError(file, "not the results of farmbench run: " + json_reason(error));
  } catch (const InputError& error) {
    throw InputError(file, error.what());
  }
  for (FarmResult& farm : result.farms) read_times(output, farm);
  return result;
}

RunSummary report(const fs::path& output, std::uint64_t seed) {
  RunSummary summary{.result = read_results(output), .table = {}};
  summary.resumed = summary.result.farms.size();
  try {
    summary.table = make_table(summary.result, seed);
    write_reports(output, summary.result, summary.table);
  } catch (const std::logic_error& error) {  // what tables take for granted was edited away
    throw InputError(output / "results.json",
                     "its parts do not fit together ({}); farmbench run writes it anew",
                     error.what());
  }
  return summary;
}

}  // namespace plotscan::farmbench
