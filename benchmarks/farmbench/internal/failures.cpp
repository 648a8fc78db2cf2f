// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/failures.h"

#include <algorithm>

#include <fmt/core.h>

#include "estimate/diagnostics.h"
#include "farmbench/figure_text.h"

namespace plotscan::farmbench {
namespace {

// Why the method measured nothing where plots are, "" where it did.
std::string reason_of(const MethodResult& run) {
  if (!run.failure.empty() || run.score.plots.empty()) return run.failure;
  const auto why = run.diagnostics.find(estimate::kWhyNoPlots);
  const bool is_stated = why != run.diagnostics.end() && why->is_string();
  return is_stated ? "no plots: " + why->get<std::string>() : "";
}

std::vector<std::string> failure_lines(const SuiteResult& result) {
  std::vector<std::string> lines;
  for (const std::string& method : result.methods) {
    for (const CaseInfo& info : result.cases) {
      std::size_t farms = 0;
      std::size_t failed = 0;
      std::string first;
      for (const FarmResult& farm : result.farms) {
        const auto run = std::ranges::find(farm.methods, method, &MethodResult::method);
        if (farm.case_name != info.name || run == farm.methods.end()) continue;
        ++farms;
        const std::string reason = reason_of(*run);
        if (reason.empty()) continue;
        if (++failed == 1) first = reason;
      }
      if (failed == 0) continue;
      std::ranges::replace(first, '\n', ' ');
      lines.push_back(fmt::format("{}, {}: {} of {}, {}", method, info.name, failed,
                                  counted(farms, "farm"), first));
    }
  }
  return lines;
}

}  // namespace

std::string failure_list(const std::string& heading, const SuiteResult& result) {
  std::string list;
  for (const std::string& line : failure_lines(result)) list += "- " + line + "\n";
  return list.empty() ? "" : "\n" + heading + "\n\n" + list;
}

void add_failures(const SuiteResult& result, std::vector<std::string>& lines) {
  const std::vector<std::string> failures = failure_lines(result);
  if (!failures.empty()) lines.insert(lines.end(), {"", "Gave up:"});
  lines.insert(lines.end(), failures.begin(), failures.end());
}

}  // namespace plotscan::farmbench
