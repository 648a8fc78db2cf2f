// SPDX-License-Identifier: Apache-2.0
#include "farmbench/command_method.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include <unistd.h>

#include "core/contains.h"
#include "core/error.h"
#include "core/printable.h"
#include "core/temporary_path.h"
#include "core/yaml_section.h"
#include "farmbench/blind_files.h"
#include "farmbench/entry/command_line.h"
#include "farmbench/entry/entered_plots.h"
#include "farmbench/entry/sha256.h"
#include "farmbench/methods.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr double kMostSeconds = 7.0 * 24 * 3600;
constexpr double kMostMemory_gb = 1024;

// The value of each {place} of a command, for files in this folder.
std::map<std::string, std::string> values_in(const fs::path& folder, const CommandMethod& method,
                                             int threads) {
  return {{"cloud", (folder / "cloud.pcd").string()},
          {"las", (folder / "cloud.las").string()},
          {"poses", (folder / "poses.csv").string()},
          {"boxes", (folder / "boxes.geojson").string()},
          {"boxes_csv", (folder / "boxes.csv").string()},
          {"out", (folder / "plots.geojson").string()},
          {"out_csv", (folder / "plots.csv").string()},
          {"threads", std::to_string(threads)},
          {"suite", method.suite_folder.string()}};
}

bool takes_boxes(const CommandMethod& method) {
  return names_place(method.words, "boxes") || names_place(method.words, "boxes_csv");
}

// Path of a program found along PATH; its name where it is not found.
fs::path found_program(const std::string& program) {
  if (program.find('/') != std::string::npos) return program;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    fs::path file = fs::path(folder) / program;
    if (access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file)) return file;
  }
  return program;
}

// Whether the word names a file, wherever farmbench runs. It may be no path at all: a whole script.
bool is_file(const std::string& word) {
  std::error_code no_path;
  return word.starts_with('/') && fs::is_regular_file(word, no_path);
}

// One path of a suite's folder however the suite was named, so that {suite} is the same in a plan.
fs::path folder_of(const fs::path& suite) {
  return fs::absolute(suite).lexically_normal().parent_path();
}

void write_inputs(const CommandMethod& method, const Field& field, const fs::path& folder) {
  if (names_place(method.words, "cloud")) write_blind_cloud(field.cloud, folder / "cloud.pcd");
  if (names_place(method.words, "las")) write_blind_cloud(field.cloud, folder / "cloud.las");
  if (names_place(method.words, "poses")) fs::copy_file(field.poses, folder / "poses.csv");
  if (takes_boxes(method)) write_boxes(folder, field.plots);
}

// The end of a program's output, which as a whole may fill a disk.
std::string end_of(const fs::path& log) {
  constexpr std::streamoff kMostBytes = 65'536;
  std::ifstream in(log, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  if (size <= 0) return "";
  std::string text(static_cast<std::size_t>(std::min(size, kMostBytes)), '\0');
  in.seekg(-static_cast<std::streamoff>(text.size()), std::ios::end);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

// The last line of a program's output, where most programs say what went wrong. Its bytes may be of
// any encoding or none; the text goes into JSON.
std::string last_line(const fs::path& log) {
  constexpr std::size_t kMostBytes = 300;
  std::string text = end_of(log);
  std::ranges::replace(text, '\r', '\n');  // a progress display writes its lines over each other
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of(" \t") != std::string::npos) last = line;
  last = printable(last);
  std::size_t end = std::min(last.size(), kMostBytes);
  while (end < last.size() && (last[end] & 0xc0) == 0x80) --end;  // at a character's beginning
  return last.substr(0, end);
}

// The plots that the program wrote.
std::vector<estimate::PlotEstimate> read_output(const fs::path& folder, const Field& field) {
  std::vector<fs::path> files;
  for (const char* name : {"plots.geojson", "plots.csv"})
    if (fs::exists(folder / name)) files.push_back(folder / name);
  if (files.size() != 1)
    throw InputError(files.empty() ? "wrote no output" : "wrote both {out} and {out_csv}");
  Problems problems;
  EnteredPlots entered = read_entered_plots(files.front(), problems);
  take_boxes(entered, field.plots, problems);
  problems.raise("its output");
  return entered.plots;
}

}  // namespace

CommandMethod command_method(const std::string& name, const std::string& command,
                             const ProcessLimits& limits, const fs::path& suite_folder) {
  CommandMethod method{.name = name,
                       .command = command,
                       .words = split_command(command),
                       .limits = limits,
                       .suite_folder = suite_folder};
  const std::string program = substituted(method.words, values_in("", method, 1)).front();
  if (program.find('/') != std::string::npos && !program.starts_with('/'))
    throw InputError("the command begins with a relative path; write {suite}/" + program +
                     ", which counts from the suite's folder");
  const bool as_table = names_place(method.words, "out_csv");
  if (names_place(method.words, "out") == as_table)
    throw InputError(std::string("the command names ") + (as_table ? "two outputs" : "no output") +
                     "; it must name one: {out} (GeoJSON) or {out_csv}");
  if (takes_boxes(method)) method.name += kTrueBoxes;
  return method;
}

CommandMethod command_method(const std::string& entered, const fs::path& suite) {
  const std::size_t equals = entered.find('=');
  const std::string name = entered.substr(0, equals);
  const bool is_ours = contains(known_methods(), name, &Method::name);
  if (equals == std::string::npos || !is_table_name(name) || is_ours)
    throw InputError("\"" + entered +
                     "\" must be NAME=COMMAND, the name 1 to 40 letters, digits, "
                     "'-' and '_' and none of Plotscan's methods'");
  return command_method(name, entered.substr(equals + 1), {}, folder_of(suite));
}

CommandMethod read_command_method(const YamlSection& entry, const std::string& name) {
  ProcessLimits limits;
  limits.seconds = entry.number("seconds", {0.001, kMostSeconds}, limits.seconds);
  const double memory_gb = entry.number("memory_gb", {0.01, kMostMemory_gb},
                                        static_cast<double>(limits.memory_bytes >> 30));
  limits.memory_bytes = static_cast<std::uint64_t>(memory_gb * 0x1p30);
  const std::string command = entry.text("command");
  try {
    return command_method(name, command, limits, folder_of(entry.file()));
  } catch (const InputError& error) {
    entry.fail("command", std::string("does not hold: ") + error.what());
  }
}

json made_from(const CommandMethod& method) {
  json files = json::object();
  const auto values = values_in("", method, 1);
  for (const std::string& word : substituted(method.words, values)) {
    if (is_file(word)) files[word] = sha256_of_file(word);
  }
  const std::string program = found_program(substituted(method.words, values).front()).string();
  if (is_file(program)) files[program] = sha256_of_file(program);
  return {{"name", method.name},
          {"command", method.command},
          {"seconds", method.limits.seconds},
          {"memory_bytes", method.limits.memory_bytes},
          {"sha256", files}};
}

MethodRun run_command_method(const CommandMethod& method, const Field& field) {
  MethodRun run{.estimate = {.method = method.name}, .result = {.method = method.name}};
  const fs::path task = field.poses.parent_path().parent_path();
  const TemporaryPath folder(task.string() + "-entry-" + std::to_string(getpid()));
  const TemporaryPath log(folder.path().string() + ".log");  // the program's own folder is empty
  fs::create_directories(folder.path());
  write_inputs(method, field, folder.path());
  const std::vector<std::string> arguments =
      substituted(method.words, values_in(fs::absolute(folder.path()), method, field.threads));
  const FinishedProcess finished =
      run_process(arguments, folder.path(), fs::absolute(log.path()), method.limits);
  run.result.seconds = finished.seconds;
  run.result.peak_memory_mb = static_cast<double>(finished.peak_bytes) / 1e6;
  run.result.failure = finished.failure;
  const std::string said = finished.failure.empty() ? "" : last_line(log.path());
  if (!said.empty()) run.result.failure += ": " + said;
  if (!run.result.failure.empty()) return run;
  try {
    run.estimate.plots = read_output(folder.path(), field);
  } catch (const InputError& error) {
    run.result.failure = error.what();
  }
  return run;
}

}  // namespace plotscan::farmbench
