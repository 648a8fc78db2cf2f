// SPDX-License-Identifier: Apache-2.0
#include "farmbench/submission/score_submission.h"

#include <set>
#include <utility>

#include <unistd.h>

#include "core/contains.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/manifest.h"
#include "core/output_file.h"
#include "core/output_folder.h"
#include "core/temporary_path.h"
#include "farmbench/entry/sha256.h"
#include "farmbench/farm_scan.h"
#include "farmbench/methods.h"
#include "farmbench/run.h"
#include "farmbench/submission/internal/submission.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

// The truth of a field.
struct FieldTruth {
  std::vector<score::TruePlot> plots;
  std::string farm_sha256;
};

FieldTruth truth_of(const BlindField& field, const fs::path& folder, int threads) {
  fs::create_directories(folder);
  const FarmPlace place{field.suite_case, field.seed, folder, threads};
  make_farm(place);
  FieldTruth truth{.plots = standing_plots(place),
                   .farm_sha256 = sha256_of_folder(folder / "farm" / "truth")};
  if (field.suite_case.without_plots) truth.plots.clear();
  fs::remove_all(folder);
  return truth;
}

// The field's entry in the submission's task.json, null where it has none.
json task_entry(const Submission& submission, const std::string& code) {
  if (submission.task.is_null()) return {};
  for (const json& field : submission.task["fields"])
    if (field["field"] == code) return field;
  return {};
}

void require_same_farm(const Submission& submission, const std::string& code,
                       const FieldTruth& truth, Problems& problems) {
  if (submission.task.is_null()) return;
  const json entry = task_entry(submission, code);
  if (entry.is_null() || entry["farm_sha256"] != blinded_farm_sha256(code, truth.farm_sha256))
    problems.add("task.json",
                 "is of other farms: field " + code + " is not there, or has another farm_sha256");
}

std::string cloud_sha256(const Submission& submission, const std::string& code) {
  const json entry = task_entry(submission, code);
  if (entry.is_null() || !entry["sha256"].is_object()) return "";
  for (const char* cloud : {"cloud.pcd", "cloud.las"})
    if (entry["sha256"].contains(cloud) && entry["sha256"][cloud].is_string())
      return entry["sha256"][cloud];
  return "";
}

EnteredFarm scored(const BlindField& field, const FieldTruth& truth, const Submission& submission) {
  EnteredFarm farm{.case_name = field.suite_case.name,
                   .seed = field.seed,
                   .field = field.code,
                   .farm_sha256 = truth.farm_sha256,
                   .cloud_sha256 = cloud_sha256(submission, field.code),
                   .file_sha256 = "",
                   .result = {.method = submission.method}};
  estimate::Estimate estimate{.method = submission.method};
  const auto entered = submission.fields.find(field.code);
  if (entered == submission.fields.end()) {
    farm.result.failure = "no file was handed in";
  } else {
    estimate.plots = entered->second.plots;
    farm.file_sha256 = submission.file_sha256.at(field.code);
  }
  farm.result.score = score::score_field(truth.plots, estimate);
  return farm;
}

// Whether the plots that were found stand in the true boxes: no method finds these to a ten
// thousandth.
bool in_true_boxes(const std::vector<EnteredFarm>& farms) {
  constexpr double kTheSame = 0.9999;  // intersection over union
  std::size_t found = 0;
  for (const EnteredFarm& farm : farms) {
    for (const score::PlotScore& plot : farm.result.score.plots) {
      if (!plot.found) continue;
      if (plot.found->iou < kTheSame) return false;
      ++found;
    }
  }
  return found > 0;
}

// Where farms are made again.
fs::path work_folder() {
  std::error_code none;
  const fs::path folder = fs::temp_directory_path(none);
  if (none)
    throw InputError("the folder for temporary files, $TMPDIR or /tmp, cannot be used (" +
                     none.message() + "); name another one in TMPDIR");
  return folder / (".farmbench-score-" + std::to_string(getpid()));
}

// Scores of a submission that is sound; throws where it is not. `apart` gets the fields all of
// whose plots lie apart from the true ones.
Entry score_fields(const ScoreSubmissionOptions& options, const Suite& suite,
                   const ProgressReport& progress, std::vector<std::string>& apart) {
  const std::vector<BlindField> fields = blind_fields(suite, options.suite);
  Problems problems;
  Submission submission = read_submission(options.submission, fields, problems);
  problems.raise(options.submission);
  const TemporaryPath work(work_folder());
  std::vector<FieldTruth> truths;
  for (const BlindField& field : fields) {
    truths.push_back(truth_of(field, work.path(), options.threads));
    const auto entered = submission.fields.find(field.code);
    if (entered != submission.fields.end()) {
      take_boxes(entered->second, truths.back().plots, problems);
      if (score::lie_apart(truths.back().plots,
                           {.method = submission.method, .plots = entered->second.plots}))
        apart.push_back(field.code);
    }
    require_same_farm(submission, field.code, truths.back(), problems);
    if (progress) progress(static_cast<double>(truths.size()) / static_cast<double>(fields.size()));
  }
  problems.raise(options.submission);
  Entry entry{.method = submission.method,
              .suite = suite.name,
              .program_sha256 = submission.program_sha256,
              .scorer_sha256 = sha256_of_file("/proc/self/exe"),
              .farms = {}};
  for (std::size_t i = 0; i < fields.size(); ++i)
    entry.farms.push_back(scored(fields[i], truths[i], submission));
  if (submission.in_given_boxes() || in_true_boxes(entry.farms)) entry.method += kTrueBoxes;
  for (EnteredFarm& farm : entry.farms) farm.result.method = entry.method;
  return entry;
}

using Farms = std::set<std::pair<std::string, std::uint64_t>>;

// The results that the folder holds, without entries; where it holds none, the suite's farms
// without a method.
SuiteResult earlier_results(const fs::path& output, const Suite& suite) {
  std::vector<FarmResult> farms;
  Farms wanted;
  for (const SuiteCase& suite_case : suite.cases) {
    for (const std::uint64_t seed : suite.seeds) {
      farms.push_back({.case_name = suite_case.name, .seed = seed});
      wanted.emplace(suite_case.name, seed);
    }
  }
  const fs::path file = output / "results.json";
  if (!fs::exists(file)) {
    SuiteResult result = result_of(suite, std::move(farms));
    result.methods.clear();
    return result;
  }
  SuiteResult result = read_results(output);
  const auto is_entered = [&](const std::string& method) {
    return contains(result.entered, method);
  };
  Farms held;
  for (FarmResult& farm : result.farms) {
    held.emplace(farm.case_name, farm.seed);
    std::erase_if(farm.methods,
                  [&](const MethodResult& method) { return is_entered(method.method); });
  }
  if (result.suite != suite.name || held != wanted)
    throw InputError(file,
                     "holds results of other farms; name the suite, the seeds and the secret "
                     "that it was run with, or another folder");
  std::erase_if(result.methods, is_entered);
  result.entered.clear();
  return result;
}

void require_addable(const Entry& entry, const SuiteResult& earlier,
                     const ScoreSubmissionOptions& options) {
  if (contains(earlier.methods, entry.method))
    throw InputError(options.submission, "\"{}\" is the name of another method of the results",
                     entry.method);
  if (const EnteredFarm* farm = farm_of_other_truth(entry, earlier))
    throw InputError(
        *options.output / "results.json",
        "case {}, seed {} has another truth than the suite's farm has now; run the suite again",
        farm->case_name, farm->seed);
}

void add_to_results(const ScoreSubmissionOptions& options, const Entry& entry, SuiteResult result) {
  const fs::path& output = *options.output;
  add_entries(output, result, entry);
  json results = {{"farms", result.farms.size()}, {"finished", false}};
  json of_run = {{"suite", result.suite}};
  if (fs::exists(output / "manifest.json")) {
    const json earlier = read_manifest(output);
    results = earlier["results"];
    of_run = earlier["options"];
  }
  fs::create_directories(output);
  const Manifest manifest{.command = kRunCommand,
                          .seed = options.seed,
                          .options = std::move(of_run),
                          .inputs = {options.suite.file},
                          .results = std::move(results)};
  write_manifest(output, manifest);
  write_entry(output, entry);
  write_whole_file(output / "results.json", json_lines(json(result)));
  report(output, options.seed);
  write_manifest(output, manifest);
}

ScoredSubmission alone(const Entry& entry, const Suite& suite, std::uint64_t seed) {
  ScoredSubmission scored;
  std::vector<FarmResult> farms;
  for (const SuiteCase& suite_case : suite.cases) {
    for (const EnteredFarm& farm : entry.farms) {
      if (farm.case_name != suite_case.name) continue;
      farms.push_back({.case_name = farm.case_name, .seed = farm.seed, .methods = {farm.result}});
      if (farm.file_sha256.empty()) scored.missing.push_back(farm.field);
    }
  }
  scored.result = result_of(suite, std::move(farms));
  scored.result.methods = scored.result.entered = {entry.method};
  scored.table = make_table(scored.result, seed);
  return scored;
}

}  // namespace

ScoredSubmission score_submission(const ScoreSubmissionOptions& options,
                                  const ProgressReport& progress) {
  const Suite suite = chosen_suite(options.suite);
  std::optional<SuiteResult> earlier;
  if (options.output) {
    require_own_folder(*options.output, kRunCommand);
    require_apart(*options.output, {{options.submission}});
    earlier = earlier_results(*options.output, suite);
  }
  std::vector<std::string> apart;
  const Entry entry = score_fields(options, suite, progress, apart);
  if (earlier) {
    require_addable(entry, *earlier, options);
    add_to_results(options, entry, std::move(*earlier));
  }
  ScoredSubmission scored = alone(entry, suite, options.seed);
  scored.apart = std::move(apart);
  for (const EnteredFarm& farm : entry.farms)
    if (const std::string hint = score::unit_hint(farm.result.score); !hint.empty())
      scored.hints[hint].push_back(farm.field);
  return scored;
}

}  // namespace plotscan::farmbench
