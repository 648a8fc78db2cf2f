// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "commands.h"
#include "core/data_folder.h"
#include "farmbench/export/dataset.h"
#include "farmbench/figure_text.h"

namespace plotscan {
namespace {

void run_export(const Program& program, farmbench::ExportOptions options) {
  options.suite.file = found_or_shipped(options.suite.file, "benchmarks/suites");
  options.threads = program.common().threads;
  const farmbench::ExportSummary summary =
      farmbench::export_suite(options, program.progress(options.suite.file.stem().string()));
  program.result({{"output", options.output.string()},
                  {"fields", summary.fields},
                  {"points", summary.points}});
  program.say("{}: {}, {:.1f} million points; TASK.md says what is asked", options.output.string(),
              farmbench::counted(summary.fields, "field"),
              1e-6 * static_cast<double>(summary.points));
}

// The command line that writes the same data set.
std::string dataset_command(const farmbench::ExportOptions& options) {
  std::string command = "farmbench export " + options.suite.file.string() + " --dataset -o DIR";
  if (options.suite.seeds) command += " --seeds " + std::to_string(*options.suite.seeds);
  if (options.suite.secret) command += " --secret-file SECRET";
  return command;
}

void run_dataset(const Program& program, farmbench::ExportOptions options) {
  const std::string command = dataset_command(options);
  options.suite.file = found_or_shipped(options.suite.file, "benchmarks/suites");
  options.threads = program.common().threads;
  const farmbench::DatasetSummary summary = farmbench::export_dataset(
      options, command, program.progress(options.suite.file.stem().string()));
  program.result({{"output", options.output.string()},
                  {"farms", summary.farms},
                  {"scans", summary.scans},
                  {"points", summary.points}});
  program.say("{}: {}, {}, {:.1f} million points; README.md is its card", options.output.string(),
              farmbench::counted(summary.farms, "farm"), farmbench::counted(summary.scans, "scan"),
              1e-6 * static_cast<double>(summary.points));
}

}  // namespace

void declare_export(Program& program) {
  const auto options = std::make_shared<farmbench::ExportOptions>();
  const auto dataset = std::make_shared<bool>(false);
  CLI::App& command = program.command(
      "export",
      "Write a suite's clouds for others: without labels to measure, or with them to learn.",
      [&program, options, dataset] {
        if (*dataset)
          run_dataset(program, *options);
        else
          run_export(program, *options);
      },
      {.threads = true});
  command.add_option("SUITE", options->suite.file, "suite (YAML), or the name of a shipped one")
      ->required();
  command.add_option("-o,--output", options->output, "folder to write")->required();
  command
      .add_option("--format", options->parts.formats,
                  "pcd, las, and pcap for the sensor's packets, separated by commas (default: pcd)")
      ->delimiter(',');
  command.add_flag("--boxes", options->parts.boxes,
                   "give the plots' boxes too (boxes.csv, boxes.geojson)");
  command
      .add_flag("--dataset", *dataset,
                "write labelled scans to learn from in place of a task (docs/dataset.md)")
      ->excludes("--format")
      ->excludes("--boxes");
  command.add_option(
      "--seeds", options->suite.seeds,
      "number of seeds of each case, from the suite's first one on (default: the suite's)");
  command
      .add_option("--secret-file", options->suite.secret,
                  "file whose bytes the seeds are drawn from, of a blind contest")
      ->check(CLI::ExistingFile);
  command.add_flag("--force", options->replace, "replace OUTPUT, an earlier export");
}

}  // namespace plotscan
