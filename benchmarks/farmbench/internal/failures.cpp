// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/failures.h"

#include <algorithm>

#include <fmt/core.h>

namespace plotscan::farmbench {

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
        if (run->failure.empty()) continue;
        if (++failed == 1) first = run->failure;
      }
      if (failed == 0) continue;
      std::ranges::replace(first, '\n', ' ');
      lines.push_back(fmt::format("{}, {}: {} of {} {}, {}", method, info.name, failed, farms,
                                  farms == 1 ? "farm" : "farms", first));
    }
  }
  return lines;
}

}  // namespace plotscan::farmbench
