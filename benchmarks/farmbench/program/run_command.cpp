// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/core.h>

#include "commands.h"
#include "core/data_folder.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/stopwatch.h"
#include "farmbench/figure_text.h"
#include "farmbench/reports.h"
#include "farmbench/run.h"
#include "suite_options.h"

namespace plotscan {
namespace {

void say_summary(const Program& program, const farmbench::RunSummary& summary,
                 const std::string& output) {
  for (const std::string& line : farmbench::summary_lines(summary.result, summary.table))
    program.say(line);
  program.say(std::string("Written: ") + (summary.result.sweep ? "sweep.csv, sweep.md, " : "") +
              "table.csv, results.json, leaderboard.md in " + output);
  program.say("To look at: " + (std::filesystem::path(output) / "report.html").string());
  program.result({{"output", output},
                  {"farms", summary.result.farms.size()},
                  {"resumed", summary.resumed},
                  {"table", summary.table}});
}

void run_suite(const Program& program, farmbench::RunOptions options) {
  options.suite = found_or_shipped(options.suite, "benchmarks/suites");
  options.threads = program.common().threads;
  options.seed = program.common().seed;
  options.build = file_hash("/proc/self/exe");
  if (options.jobs == 0) options.jobs = options.threads;
  const Stopwatch watch;
  const farmbench::RunSummary summary =
      farmbench::run(options, program.progress(options.suite.stem().string()),
                     [&](const farmbench::FarmResult& farm, double farm_seconds) {
                       program.log(fmt::format("case {}, seed {}: {:.1f} s", farm.case_name,
                                               farm.seed, farm_seconds));
                     });
  const double seconds = watch.seconds();
  program.say("{}, {} of them run before, {:.0f} s",
              farmbench::counted(summary.result.farms.size(), "farm"), summary.resumed, seconds);
  program.say("");
  say_summary(program, summary, options.output.string());
}

void run_sweep(const Program& program, farmbench::RunOptions options) {
  options.suite = found_or_shipped(options.suite, "benchmarks/suites");
  if (!farmbench::load_suite(options.suite).sweep)
    throw InputError(options.suite, "has no axes: it is a suite; farmbench run runs it");
  run_suite(program, std::move(options));
}

// What `run` and `sweep` share.
void declare_running(CLI::App& command, farmbench::RunOptions& options) {
  command
      .add_option("-o,--output", options.output,
                  "results folder; farms whose results it holds are not run again")
      ->required();
  command
      .add_option("--jobs", options.jobs,
                  "farms that run at a time (default: 0, one for each thread)")
      ->check(CLI::Range(0, 1024));
  command.add_flag("--force", options.force, "run every farm again");
}

void declare_suite_run(Program& program) {
  const auto options = std::make_shared<farmbench::RunOptions>();
  options->jobs = 0;
  CLI::App& command = program.command("run", "Run a suite: farms, flights, estimates, scores.",
                                      [&program, options] { run_suite(program, *options); },
                                      {.seed = kTableSeed, .threads = true});
  add_suite_options(command, *options);
  declare_running(command, *options);
}

void declare_sweep(Program& program) {
  const auto options = std::make_shared<farmbench::RunOptions>();
  options->jobs = 0;
  CLI::App& command = program.command(
      "sweep", "Which flight do I need? Error and plots found, flight by flight.",
      [&program, options] { run_sweep(program, *options); }, {.seed = kTableSeed, .threads = true});
  command
      .add_option("SWEEP", options->suite,
                  "suite with axes (YAML, docs/sweep.md), or the name of a shipped one, such as "
                  "flight-soybean")
      ->required();
  add_choice_options(command, *options);
  declare_running(command, *options);
}

void declare_report_page(Program& program) {
  const auto results = std::make_shared<std::string>();
  CLI::App& command = program.command(
      "report", "Make the table and the report again from results.json.",
      [&program, results] {
        say_summary(program, farmbench::report(*results, program.common().seed), *results);
      },
      {.seed = kTableSeed});
  command.add_option("RESULTS", *results, "results folder of farmbench run or sweep")->required();
}

}  // namespace

void declare_run(Program& program) {
  declare_suite_run(program);
  declare_sweep(program);
  declare_report_page(program);
}

}  // namespace plotscan
