// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/contains.h"
#include "core/error.h"
#include "core/program.h"
#include "core/temporary_path.h"
#include "core/text.h"
#include "heights/agreement.h"
#include "strata/empty_field.h"
#include "strata/field_plan.h"
#include "strata/kept_field.h"
#include "strata/measured_field.h"
#include "strata/measurement_table.h"
#include "strata/thinned_cloud.h"

namespace {

using namespace plotscan;
namespace fs = std::filesystem;

// A farm of kentland has as many plots as three or four others.
constexpr const char* kLargeStratum = "kentland";
constexpr int kFarmsALargeOne = 3;

struct Arguments {
  std::string secret;
  int farms = 10;
  std::vector<std::string> strata;  // none: all
  std::optional<double> density_per_m2;
  int hand_measured = 0;
  std::optional<fs::path> keep;
  fs::path source = ".";
  std::optional<fs::path> meshes;
};

// One field to measure: a farm, or a field without plots.
struct Task {
  std::string stratum;
  int index = 0;
  bool empty = false;
};

std::vector<std::string> all_strata() {
  std::vector<std::string> names = strata::farm_strata();
  names.insert(names.end(), strata::empty_kinds().begin(), strata::empty_kinds().end());
  return names;
}

void require_known(const std::vector<std::string>& chosen) {
  const std::vector<std::string> known = all_strata();
  for (const std::string& name : chosen) {
    if (!contains(known, name))
      throw InputError("there is no stratum \"" + name + "\"; there are " + joined(known, ", "));
  }
}

strata::Sources sources_of(const Arguments& arguments) {
  const fs::path beside = arguments.source / ".." / "shared" / "data" / "plants" / "cropcraft";
  return {.strata = arguments.source / "benchmarks" / "strata",
          .worlds = arguments.source / "worlds",
          .meshes = arguments.meshes.value_or(beside)};
}

std::vector<Task> plan(const Program& program, const Arguments& arguments) {
  std::vector<Task> tasks;
  for (const std::string& name : all_strata()) {
    if (!arguments.strata.empty() && !contains(arguments.strata, name)) continue;
    const bool empty = contains(strata::empty_kinds(), name);
    if (name == "others" && !fs::exists(sources_of(arguments).meshes) && !arguments.meshes) {
      program.say("others: left out, as " + sources_of(arguments).meshes.string() + " is absent");
      continue;
    }
    const int fields =
        name == kLargeStratum ? std::max(1, arguments.farms / kFarmsALargeOne) : arguments.farms;
    for (int index = 0; index < fields; ++index) tasks.push_back({name, index, empty});
  }
  return tasks;
}

strata::MeasuredField measure(const Task& task, const Arguments& arguments, const fs::path& folder,
                              int threads) {
  strata::KeptField field;
  strata::MeasureOptions options{.hand_measured = arguments.hand_measured, .threads = threads};
  if (task.empty) {
    field = strata::keep_empty_field(arguments.secret, task.stratum, task.index, folder);
  } else {
    const strata::FieldPlan plan =
        strata::plan_field(arguments.secret, task.stratum, task.index, sources_of(arguments));
    field = strata::keep_farm(plan, folder, threads);
    options.stated = plan.stated;
  }
  if (arguments.density_per_m2)
    field.cloud = strata::thinned_cloud(field.cloud, *arguments.density_per_m2, threads);
  return strata::measure_field(task.stratum, task.index, field, options);
}

strata::MeasuredField measure_kept_or_not(const Task& task, const Arguments& arguments,
                                          int threads) {
  const std::string name = task.stratum + "-" + std::to_string(task.index);
  if (arguments.keep) return measure(task, arguments, *arguments.keep / name, threads);
  const TemporaryPath work(partial_path(fs::temp_directory_path() / name));
  return measure(task, arguments, work.path(), threads);
}

void run(const Program& program, const Arguments& arguments) {
  require_known(arguments.strata);
  const std::vector<Task> tasks = plan(program, arguments);
  const auto progress = program.progress("measure");
  strata::Measurement measurement;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    auto& fields = tasks[i].empty ? measurement.empty_fields : measurement.farms;
    fields.push_back(measure_kept_or_not(tasks[i], arguments, program.common().threads));
    if (program.common().verbosity > 0) program.say(strata::field_line(fields.back()));
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(tasks.size()));
  }
  for (const std::string& line : strata::table_lines(measurement)) program.say(line);
  program.result(strata::to_json(measurement));
}

}  // namespace

int main(int argc, char** argv) {
  Program program("measure_plots", "Measure the estimator on fresh farms of every kind of field.");
  Arguments arguments;
  CLI::App& command = program.command(
      "run", "Draw fields from a word, fly, estimate and score (docs/benchmark.md).",
      [&] { run(program, arguments); }, {.threads = true});
  command
      .add_option("--secret", arguments.secret,
                  "word that fields are drawn from: another word, other fields")
      ->required();
  command
      .add_option("--farms", arguments.farms,
                  "fields of each stratum (of kentland a third as many)")
      ->check(CLI::Range(1, 10'000));
  command
      .add_option("--strata", arguments.strata,
                  "only these strata (a,b,c); " + joined(all_strata(), ", "))
      ->delimiter(',');
  command
      .add_option("--density", arguments.density_per_m2,
                  "thin each cloud to so many returns in its median square metre")
      ->check(CLI::Range(1.0, 1e6));
  command
      .add_option(
          "--hand-measured", arguments.hand_measured,
          "so many plots of each trial are measured by hand, three plants in each; the others' "
          "mean heights are made to agree, and scored (default: none)")
      ->check(CLI::Range(static_cast<int>(heights::kLeastMeasured), 10'000));
  command.add_option("--keep", arguments.keep,
                     "folder of fields, STRATUM-INDEX/{farm,scan}: those there are not made again");
  command.add_option("--source", arguments.source, "Plotscan's sources: benchmarks, worlds");
  command
      .add_option("--meshes", arguments.meshes,
                  "CropCraft's plants, for the stratum others: a folder with bean/bean_medium.obj, "
                  "bean/bean_big.obj and maize/maize_big_1.obj (default: "
                  "shared/data/plants/cropcraft beside the sources; others is left out without it)")
      ->check(CLI::ExistingDirectory);
  return program.run(argc, argv);
}
