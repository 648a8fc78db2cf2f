// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "estimate/estimate.h"
#include "farmbench/entry/child_process.h"
#include "farmbench/farm_result.h"

namespace plotscan {
class YamlSection;
}

namespace plotscan::farmbench {

struct Field;

// Somebody's program as a method of a suite (docs/submissions.md):
//   {name: mine, command: "my_tool {cloud} {out}", seconds: 600, memory_gb: 8}
struct CommandMethod {
  std::string name;     // of its rows; " true-boxes" behind it where it is given the boxes
  std::string command;  // as the suite has it
  std::vector<std::string> words = {};
  ProcessLimits limits = {};
  std::filesystem::path suite_folder = {};  // {suite}
};

// A command as a method. Throws InputError on one that cannot be split, names an unknown place or
// no output, and on a program given by a relative path.
CommandMethod command_method(const std::string& name, const std::string& command,
                             const ProcessLimits& limits,
                             const std::filesystem::path& suite_folder);

// The same from "NAME=COMMAND", as given on the command line. Throws InputError on a NAME that
// tables cannot hold or that one of Plotscan's methods has, too.
CommandMethod command_method(const std::string& entered, const std::filesystem::path& suite);

// Reads an entry of a suite's methods; errors name its key.
CommandMethod read_command_method(const YamlSection& entry, const std::string& name);

// What the method's results depend on: the command, its limits, and SHA-256 of the program and of
// all files that it names.
nlohmann::json made_from(const CommandMethod& method);

// What a method says of a field, and how it went; not scored yet.
struct MethodRun {
  estimate::Estimate estimate;
  MethodResult result;
};

// Runs the program in a folder of its own, with the files that its command names (without labels),
// and reads what it wrote. Any error of the program is reported as the result's failure.
MethodRun run_command_method(const CommandMethod& method, const Field& field);

}  // namespace plotscan::farmbench
