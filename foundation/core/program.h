// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "core/progress.h"

namespace plotscan {

// Which of the common options a command takes besides -v and -q.
struct Uses {
  const char* seed =
      nullptr;           // --seed: what it is the seed of, and its default where that is not 1
  bool threads = false;  // -j
  bool json = true;      // --json
};

// The options that commands share.
struct CommonOptions {
  std::uint64_t seed = 1;   // --seed
  bool seed_given = false;  // whether the user gave --seed
  int threads = 0;  // -j/--threads; set to the machine's number of processors before a command runs
  int verbosity = 0;  // -v: 1 and more, -q: -1
  bool json = false;  // --json: one JSON document on stdout in place of text
};

// One command-line program with sub-commands. A program's main.cpp declares its commands, each of
// which calls one function of a library:
//
//   int main(int argc, char** argv) {
//     Program program("farmgen", "Generate virtual phenotyping farms.");
//     GenerateArguments arguments;
//     CLI::App& generate = program.command("generate", "Generate a farm.",
//                                          [&] { run_generate(program, arguments); },
//                                          {.seed = "seed of the farm", .threads = true});
//     generate.add_option("FARM", arguments.farm, "farm description (YAML)")->required();
//     return program.run(argc, argv);
//   }
//
// Exit codes: 0 done, 2 bad input or usage (InputError, CLI11's parse errors), 3 nothing to measure
// (NothingToMeasure), 1 anything else: output that cannot be written (stdout too), memory that does
// not suffice.
class Program {
 public:
  Program(std::string name, const std::string& description);

  // Adds a sub-command. After its own options it takes the common options in `uses`. `run` is
  // called when the user chooses it.
  CLI::App& command(const std::string& name, const std::string& description,
                    std::function<void()> run, const Uses& uses = {});

  int run(int argc, char** argv);

  const CommonOptions& common() const { return common_; }

  // A line for the person at the terminal, on stdout; silent with --json or -q.
  void say(const std::string& line) const;
  // The same of a format: "{} plots".
  template <class First, class... Others>
  void say(fmt::format_string<First, Others...> format, First&& first, Others&&... others) const {
    say(fmt::vformat(format, fmt::make_format_args(first, others...)));
  }
  // A line of long work's log on stderr, where progress() has no terminal for its bar; silent with
  // -q.
  void log(const std::string& line) const;
  // What --json prints: the command's whole result. Call it once.
  void result(const nlohmann::json& document) const;
  // A line about work to come on stderr, terminal or not; silent with -q and --json.
  void announce(const std::string& line) const;
  // Progress with the time left on stderr: a bar on a terminal, elsewhere a line every ten seconds.
  // With -q or --json the report is empty.
  ProgressReport progress(const std::string& label) const;

 private:
  void add_common_options(CLI::App& command, const Uses& uses);
  int caught_run(int argc, char** argv);
  int guarded_run(int argc, char** argv);
  // What is wrong with the arguments (without the program's name), and what was meant.
  std::string usage_error(const CLI::ParseError& error,
                          const std::vector<std::string>& arguments) const;
  // A hidden flag that prints a page of the program, and ends.
  void add_page(const std::string& flag, std::string (*page)(const CLI::App&));

  std::string name_;
  CLI::App app_;
  std::vector<std::pair<CLI::App*, Uses>> commands_;
  CommonOptions common_;
  bool quiet_ = false;
};

}  // namespace plotscan
