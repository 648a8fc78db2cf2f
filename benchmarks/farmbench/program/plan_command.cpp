// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>

#include "commands.h"
#include "core/data_folder.h"
#include "core/manifest.h"
#include "core/text.h"
#include "farmbench/figure_text.h"
#include "farmbench/plan.h"
#include "farmbench/reports.h"
#include "suite_options.h"

namespace plotscan {
namespace {

std::string own_build() { return file_hash("/proc/self/exe"); }

void run_plan(const Program& program, farmbench::RunOptions options) {
  options.suite = found_or_shipped(options.suite, "benchmarks/suites");
  options.build = own_build();
  const farmbench::PlanSummary planned = farmbench::plan(options);
  program.result({{"output", options.output.string()},
                  {"farms", planned.farms},
                  {"changed", planned.changed}});
  program.say("{}: {}{}", options.output.string(), farmbench::counted(planned.farms, "farm"),
              planned.changed > 0 ? "" : ", planned before");
  program.say(
      "farmbench farm runs one of tasks.csv, farmbench merge makes the table of all; "
      "workflow/Snakefile does both (docs/scale.md)");
}

void declare_suite_plan(Program& program) {
  const auto options = std::make_shared<farmbench::RunOptions>();
  CLI::App& plan =
      program.command("plan", "Plan a suite's run on many machines: one command a farm.",
                      [&program, options] { run_plan(program, *options); });
  add_suite_options(plan, *options);
  plan.add_option("-o,--output", options->output, "results folder to make")->required();
}

struct FarmArguments {
  std::string results;
  std::string farm;
  farmbench::PlannedFarmOptions options;
};

void run_farm(const Program& program, FarmArguments& arguments) {
  arguments.options.threads = program.common().threads;
  arguments.options.build = own_build();
  const farmbench::PlannedFarm farm = farmbench::run_planned(
      arguments.results, arguments.farm, arguments.options, program.progress(arguments.farm));
  program.result({{"farm", arguments.farm},
                  {"resumed", farm.resumed},
                  {"shots", farm.result.shots},
                  {"points", farm.result.points}});
  program.say("{}: {:.2f} million points, {} methods{}", arguments.farm,
              1e-6 * static_cast<double>(farm.result.points), farm.result.methods.size(),
              farm.resumed ? "; run before" : "");
}

void declare_farm(Program& program) {
  const auto arguments = std::make_shared<FarmArguments>();
  CLI::App& farm =
      program.command("farm", "Run one farm of a planned suite.",
                      [&program, arguments] { run_farm(program, *arguments); }, {.threads = true});
  farm.add_option("RESULTS", arguments->results, "results folder of farmbench plan")->required();
  farm.add_option("FARM", arguments->farm, "its name in tasks.csv, such as flat-1")->required();
  farm.add_option("--work", arguments->options.work,
                  "folder for the farm and its scan while it runs, such as a disk of the machine's "
                  "own (default: RESULTS)")
      ->check(CLI::ExistingDirectory);
  farm.add_flag("--force", arguments->options.force, "run the farm again");
}

void run_merge(const Program& program, const std::string& results,
               farmbench::MergeOptions options) {
  options.seed = program.common().seed;
  options.build = own_build();
  const farmbench::MergeSummary merged = farmbench::merge(results, options);
  for (const std::string& line : farmbench::summary_lines(merged.run.result, merged.run.table))
    program.say(line);
  if (!merged.missing.empty())
    program.say("Farms without a result: " + joined(merged.missing, ", "));
  program.say("Written: table.csv, results.json, leaderboard.md in " + results);
  program.say("To look at: " + (std::filesystem::path(results) / "report.html").string());
  program.result({{"output", results},
                  {"farms", merged.run.result.farms.size()},
                  {"missing", merged.missing}});
}

void declare_merge(Program& program) {
  const auto results = std::make_shared<std::string>();
  const auto options = std::make_shared<farmbench::MergeOptions>();
  CLI::App& merge =
      program.command("merge", "Make the table and the report of a planned suite's farms.",
                      [&program, results, options] { run_merge(program, *results, *options); },
                      {.seed = kTableSeed});
  merge.add_option("RESULTS", *results, "results folder of farmbench plan")->required();
  merge.add_flag("--finished", options->finished_only,
                 "leave out farms that have no result, and name them");
}

}  // namespace

void declare_plan(Program& program) {
  declare_suite_plan(program);
  declare_farm(program);
  declare_merge(program);
}

}  // namespace plotscan
