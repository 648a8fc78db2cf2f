// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"
#include "farmbench/run.h"

namespace plotscan {

// Adds the options that choose the farms of a suite or sweep, and the methods to run.
inline void add_choice_options(CLI::App& command, farmbench::RunOptions& options) {
  command.add_option(
      "--seeds", options.seeds,
      "number of seeds of each case, from the suite's first one on (default: the suite's)");
  command
      .add_option("--methods", options.methods,
                  "methods to run, separated by commas (default: the suite's)")
      ->delimiter(',');
  command
      .add_option(
          "--enter", options.entered,
          "NAME=COMMAND: a program as a further method (docs/submissions.md); may be repeated")
      ->allow_extra_args(false);
}

// Adds what `run` and `plan` share: the suite, and the above.
inline void add_suite_options(CLI::App& command, farmbench::RunOptions& options) {
  command
      .add_option("SUITE", options.suite,
                  "suite (YAML), or the name of a shipped one, such as paper")
      ->required();
  add_choice_options(command, options);
  command
      .add_option(
          "--secret-file", options.secret,
          "file whose bytes the seeds are drawn from, of a blind contest (docs/submissions.md)")
      ->check(CLI::ExistingFile);
  command.add_flag(
      "--keep-clouds", options.keep_clouds,
      "keep each farm and its scan in OUTPUT/clouds (about 250 MB a farm of the paper)");
}

}  // namespace plotscan
