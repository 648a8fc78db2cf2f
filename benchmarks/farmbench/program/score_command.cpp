// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "commands.h"
#include "core/data_folder.h"
#include "core/text.h"
#include "farmbench/reports.h"
#include "farmbench/submission/score_submission.h"

namespace plotscan {
namespace {

void run_score(const Program& program, farmbench::ScoreSubmissionOptions options) {
  options.suite.file = found_or_shipped(options.suite.file, "benchmarks/suites");
  options.threads = program.common().threads;
  options.seed = program.common().seed;
  const farmbench::ScoredSubmission scored =
      farmbench::score_submission(options, program.progress(options.suite.file.stem().string()));
  for (const std::string& line : farmbench::summary_lines(scored.result, scored.table))
    program.say(line);
  if (!scored.missing.empty())
    program.say("Fields without a file: " + joined(scored.missing, ", "));
  if (!scored.apart.empty())
    program.say("In " + joined(scored.apart, ", ") +
                " all plots lie apart from the true ones: are both in the clouds' coordinates?");
  for (const auto& [hint, fields] : scored.hints)
    program.announce("note: in " + joined(fields, ", ") + ": " + hint);
  if (options.output) {
    program.say("Added to table.csv, results.json, leaderboard.md in " + options.output->string());
    program.say("To look at: " + (*options.output / "report.html").string());
  }
  program.result({{"method", scored.result.methods.front()},
                  {"missing", scored.missing},
                  {"apart", scored.apart},
                  {"table", scored.table}});
}

}  // namespace

void declare_score(Program& program) {
  const auto options = std::make_shared<farmbench::ScoreSubmissionOptions>();
  CLI::App& command = program.command("score", "Score what others measured of a suite's farms.",
                                      [&program, options] { run_score(program, *options); },
                                      {.seed = kTableSeed, .threads = true});
  command
      .add_option("SUBMISSION", options->submission,
                  "folder with submission.json and of each field FIELD.csv or FIELD.geojson")
      ->required();
  command.add_option("--suite", options->suite.file, "suite that was exported")->required();
  command.add_option("-o,--output", options->output,
                     "results folder of farmbench run, or a new one, that the scores are added to");
  command.add_option("--seeds", options->suite.seeds, "as the suite was exported with");
  command.add_option("--secret-file", options->suite.secret, "as the suite was exported with")
      ->check(CLI::ExistingFile);
}

}  // namespace plotscan
