// SPDX-License-Identifier: Apache-2.0
#include "export_command.h"

#include <memory>

#include "core/data_folder.h"
#include "core/text.h"
#include "farmbench/export/export_suite.h"

namespace plotscan {
namespace {

void run_export(const Program& program, farmbench::ExportOptions options) {
  options.suite.file = found_file(options.suite.file, "benchmarks/suites");
  options.threads = program.common().threads;
  const farmbench::ExportSummary summary =
      farmbench::export_suite(options, program.progress(options.suite.file.stem().string()));
  program.result({{"output", options.output.string()},
                  {"fields", summary.fields},
                  {"points", summary.points}});
  program.say(formatted("%s: %zu fields, %.1f million points; TASK.md says what is asked",
                        options.output.c_str(), summary.fields,
                        1e-6 * static_cast<double>(summary.points)));
}

}  // namespace

void declare_export(Program& program) {
  const auto options = std::make_shared<farmbench::ExportOptions>();
  CLI::App& command =
      program.command("export", "Write a suite's clouds without labels, for others to measure.",
                      [&program, options] { run_export(program, *options); });
  command.add_option("SUITE", options->suite.file, "suite (YAML), or the name of a shipped one")
      ->required();
  command.add_option("-o,--output", options->output, "folder to write")->required();
  command
      .add_option("--format", options->parts.formats,
                  "pcd, las, and pcap for the sensor's packets, with commas between them (pcd)")
      ->delimiter(',');
  command.add_flag("--boxes", options->parts.boxes,
                   "give the plots' boxes too (boxes.csv, boxes.geojson)");
  command.add_option("--seeds", options->suite.seeds,
                     "so many seeds of each case, from the suite's first one, not the suite's");
  command
      .add_option("--secret-file", options->suite.secret,
                  "file whose bytes the seeds are drawn from, of a blind contest")
      ->check(CLI::ExistingFile);
  command.add_flag("--force", options->replace, "replace OUTPUT, an earlier export");
}

}  // namespace plotscan
