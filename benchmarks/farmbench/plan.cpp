// SPDX-License-Identifier: Apache-2.0
#include "farmbench/plan.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/core.h>
#include <unistd.h>

#include "core/error.h"
#include "core/format_version.h"
#include "core/json_text.h"
#include "core/manifest.h"
#include "core/output_file.h"
#include "core/output_folder.h"
#include "core/temporary_path.h"
#include "core/text.h"
#include "farmbench/entries.h"
#include "farmbench/internal/farm_task.h"
#include "farmbench/internal/run_farm.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr std::size_t kNamesShown = 10;
constexpr const char* kWork = ".work-";

fs::path plan_file(const fs::path& output) { return output / "plan.json"; }

fs::path case_file(const fs::path& output, const SuiteCase& suite_case) {
  return output / "plan" / (suite_case.name + ".json");
}

// What every farm of a case is made from.
std::string case_plan(const Suite& suite, const SuiteCase& suite_case, const std::string& build) {
  json document = made_from(suite, suite_case, suite.seeds.front(), build);
  document.erase("seed");
  return json_lines(document);
}

json plan_json(const RunOptions& options) {
  json document = {{"format", kFormat},
                   {"suite", fs::absolute(options.suite).lexically_normal().string()},
                   {"suite_hash", file_hash(options.suite)},  // what the reports show may change
                   {"methods", options.methods},
                   {"entered", options.entered},
                   {"keep_clouds", options.keep_clouds},
                   {"build", options.build}};
  if (options.seeds) document["seeds"] = *options.seeds;
  if (options.secret)
    document["secret"] = fs::absolute(*options.secret).lexically_normal().string();
  return document;
}

std::string tasks_csv(const Suite& suite) {
  std::string text = "farm,case,seed,viewed\n";
  for (const SuiteCase& suite_case : suite.cases) {
    for (const std::uint64_t seed : suite.seeds) {
      text += fmt::format("{},{},{},{:d}\n", farm_name(suite_case.name, seed), suite_case.name,
                          seed, is_viewed(suite, seed));
    }
  }
  return text;
}

// Whether the file held something else.
bool write_changed(const fs::path& file, const std::string& text) {
  if (fs::exists(file) && read_text(file) == text) return false;
  write_whole_file(file, text);
  return true;
}

// The options of the plan.
RunOptions read_plan(const fs::path& output, const std::string& build) {
  const fs::path file = plan_file(output);
  if (!fs::exists(file))
    throw InputError(output, "holds no plan.json; farmbench plan SUITE -o makes such a folder");
  try {
    const json document = json::parse(read_json_text(file));
    require_known_format(document, file);
    RunOptions planned{.suite = document.at("suite").get<std::string>(),
                       .output = output,
                       .keep_clouds = document.at("keep_clouds"),
                       .methods = document.at("methods"),
                       .entered = document.at("entered"),
                       .build = document.at("build")};
    if (document.contains("seeds")) planned.seeds = document["seeds"].get<int>();
    if (document.contains("secret")) planned.secret = document["secret"].get<std::string>();
    if (planned.build != build)
      throw InputError(file, "is another build's of farmbench; plan again with this one");
    return planned;
  } catch (const json::exception& error) {
    throw InputError(file, "not farmbench's plan: " + json_reason(error));
  }
}

void require_unchanged_case(const RunOptions& planned, const Suite& suite,
                            const SuiteCase& suite_case) {
  const fs::path file = case_file(planned.output, suite_case);
  if (fs::exists(file) && read_text(file) == case_plan(suite, suite_case, planned.build)) return;
  throw InputError(planned.suite,
                   "case {}, or a file that it is made from, is not as it was planned; plan again",
                   suite_case.name);
}

FarmTask planned_task(const RunOptions& planned, const Suite& suite, const std::string& farm) {
  for (const SuiteCase& suite_case : suite.cases) {
    for (const std::uint64_t seed : suite.seeds) {
      if (farm_name(suite_case.name, seed) != farm) continue;
      require_unchanged_case(planned, suite, suite_case);
      return task_of(suite, suite_case, seed, planned.build);
    }
  }
  throw InputError(plan_file(planned.output), "plans no farm \"{}\"; tasks.csv lists them", farm);
}

// "flat-1, half-2 and 3 more".
std::string shortened(const std::vector<std::string>& names) {
  if (names.size() <= kNamesShown) return joined(names, ", ");
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(kNamesShown);
  return joined({names.begin(), end}, ", ") + " and " + std::to_string(names.size() - kNamesShown) +
         " more";
}

// Removes the work folders of farms that were killed after their result was written. They are not
// run again, so nothing else would remove them.
void remove_left_work(const fs::path& output, const std::vector<FarmTask>& tasks) {
  std::set<std::string> finished;
  for (const FarmTask& task : tasks)
    if (task.result) finished.insert("." + task.name);
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(output)) {
    const std::string name = entry.path().filename().string();
    const std::size_t work = name.rfind(kWork);
    if (work != std::string::npos && finished.contains(name.substr(0, work)))
      left.push_back(entry.path());
  }
  for (const fs::path& folder : left) fs::remove_all(folder);
}

}  // namespace

PlanSummary plan(const RunOptions& options) {
  require_own_folder(options.output, kRunCommand);
  const Suite suite = suite_of(options);
  require_results_of(options.output, suite.name);
  require_entries(options.output, suite.methods);
  make_result_folders(options.output);
  const std::size_t farms = suite.cases.size() * suite.seeds.size();
  write_run_manifest(options, suite.name, farms, false);
  write_changed(options.output / "tasks.csv", tasks_csv(suite));
  write_changed(plan_file(options.output), json_lines(plan_json(options)));
  fs::create_directories(options.output / "plan");
  PlanSummary summary{.farms = farms};
  for (const SuiteCase& suite_case : suite.cases) {
    if (write_changed(case_file(options.output, suite_case),
                      case_plan(suite, suite_case, options.build)))
      ++summary.changed;
  }
  return summary;
}

PlannedFarm run_planned(const fs::path& output, const std::string& farm,
                        const PlannedFarmOptions& options, const ProgressReport& progress) {
  const RunOptions planned = read_plan(output, options.build);
  const Suite suite = suite_of(planned);
  FarmTask task = planned_task(planned, suite, farm);
  if (!options.force) task.result = earlier_result(planned, task);
  if (task.result) return {.result = std::move(*task.result), .resumed = true};
  require_places(planned, {task});
  make_result_folders(output);  // a workflow's engine may remove empty ones
  // The farm's name is part of the folder's: other farms run beside it, on other machines too,
  // whose processes' numbers say nothing here.
  const TemporaryPath work(options.work.value_or(output) /
                           ("." + farm + kWork + std::to_string(getpid())));
  run_task(task, suite, planned, work.path(), options.threads, progress);
  return {.result = std::move(*task.result)};
}

MergeSummary merge(const fs::path& output, const MergeOptions& options) {
  RunOptions planned = read_plan(output, options.build);
  planned.seed = options.seed;
  const Suite suite = suite_of(planned);
  for (const SuiteCase& suite_case : suite.cases)
    require_unchanged_case(planned, suite, suite_case);
  std::vector<FarmTask> tasks = farm_tasks(suite, planned);
  MergeSummary summary;
  for (const FarmTask& task : tasks)
    if (!task.result) summary.missing.push_back(task.name);
  const std::string missing = std::to_string(summary.missing.size()) + " of " +
                              std::to_string(tasks.size()) +
                              " farms have no result: " + shortened(summary.missing);
  if (summary.missing.size() == tasks.size()) throw InputError(output, missing);
  if (!summary.missing.empty() && !options.finished_only)
    throw InputError(output, missing + "; --finished leaves them out");
  remove_left_work(output, tasks);
  summary.run = write_results(planned, suite, std::move(tasks));
  return summary;
}

}  // namespace plotscan::farmbench
