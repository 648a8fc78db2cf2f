// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "core/text.h"
#include "record/join_scans.h"
#include "record/scan_formats.h"

namespace plotscan {
namespace {

struct JoinArguments {
  std::vector<std::filesystem::path> parts;
  std::string scan;
  record::JoinOptions options;
};

void run_join(const Program& program, const JoinArguments& arguments) {
  const record::JoinSummary summary = record::join_scans(
      arguments.parts, arguments.scan, arguments.options, program.progress("joining"));
  program.result({{"scan", arguments.scan},
                  {"parts", summary.parts},
                  {"shots", summary.shots},
                  {"points", summary.points}});
  program.say("{}: {} parts, {:.2f} million shots, {:.2f} million points", arguments.scan,
              summary.parts, 1e-6 * static_cast<double>(summary.shots),
              1e-6 * static_cast<double>(summary.points));
}

}  // namespace

void declare_join(Program& program) {
  const auto arguments = std::make_shared<JoinArguments>();
  CLI::App& join =
      program.command("join", "Join the parts of a flight (fly --part) to the whole flight's scan.",
                      [&program, arguments] { run_join(program, *arguments); });
  join.add_option("PART", arguments->parts, "scan folders of all parts, in any order")->required();
  join.add_option("-o,--output", arguments->scan, "scan folder to write")->required();
  join.add_option(
          "--format", arguments->options.formats,
          "also write the scan as fly --format does: " + alternatives(record::further_formats()) +
              "; separated by commas, or repeated")
      ->delimiter(',')
      ->allow_extra_args(false);
  join.add_flag("--force", arguments->options.replace, "replace an existing scan folder");
}

}  // namespace plotscan
