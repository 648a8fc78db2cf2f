// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <string>

#include "export_command.h"
#include "plan_command.h"
#include "score_command.h"
#include "seed.h"
#include "suite_options.h"

#include "core/data_folder.h"
#include "core/manifest.h"
#include "core/program.h"
#include "core/text.h"
#include "farmbench/format.h"
#include "farmbench/reports.h"
#include "farmbench/run.h"

namespace {

using namespace plotscan;

void say_summary(const Program& program, const farmbench::RunSummary& summary,
                 const std::string& output) {
  for (const std::string& line : farmbench::summary_lines(summary.result, summary.table))
    program.say(line);
  program.say("Written: table.csv, results.json, leaderboard.md in " + output);
  program.say("To look at: " + (std::filesystem::path(output) / "report.html").string());
  nlohmann::json rows = nlohmann::json::array();
  for (const farmbench::TableRow& row : summary.table) rows.push_back(farmbench::to_json(row));
  program.result({{"output", output},
                  {"farms", summary.result.farms.size()},
                  {"resumed", summary.resumed},
                  {"table", rows}});
}

void run_suite(const Program& program, farmbench::RunOptions options) {
  options.suite = found_file(options.suite, "benchmarks/suites");
  options.threads = program.common().threads;
  options.seed = program.common().seed;
  options.build = file_hash("/proc/self/exe");
  if (options.jobs == 0) options.jobs = options.threads;
  const auto start = std::chrono::steady_clock::now();
  const farmbench::RunSummary summary = farmbench::run(
      options, program.progress(options.suite.stem().string()),
      [&](const farmbench::FarmResult& farm, double farm_seconds) {
        program.log(formatted("case %s, seed %llu: %.1f s", farm.case_name.c_str(),
                              static_cast<unsigned long long>(farm.seed), farm_seconds));
      });
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  program.say(formatted("%zu farms, %zu of them run before, %.0f s", summary.result.farms.size(),
                        summary.resumed, seconds));
  program.say("");
  say_summary(program, summary, options.output.string());
}

void declare_run(Program& program, farmbench::RunOptions& options) {
  CLI::App& run = program.command("run", "Run a suite: farms, flights, estimates, scores.",
                                  [&program, &options] { run_suite(program, options); },
                                  {.seed = kTableSeed, .threads = true});
  add_suite_options(run, options);
  run.add_option("-o,--output", options.output,
                 "results folder; farms whose results it holds are not run again")
      ->required();
  run.add_option("--jobs", options.jobs,
                 "farms that run at a time (default: 0, one for each thread)")
      ->check(CLI::Range(0, 1024));
  run.add_flag("--force", options.force, "run every farm again");
}

}  // namespace

int main(int argc, char** argv) {
  Program program("farmbench", "Benchmark plot and crop-height estimators on virtual farms.");
  farmbench::RunOptions options;
  options.jobs = 0;
  declare_run(program, options);
  std::string results;
  CLI::App& report = program.command(
      "report", "Make the table and the report again from results.json.",
      [&] { say_summary(program, farmbench::report(results, program.common().seed), results); },
      {.seed = kTableSeed});
  report.add_option("RESULTS", results, "results folder of farmbench run")->required();
  declare_plan(program);
  declare_export(program);
  declare_score(program);
  return program.run(argc, argv);
}
