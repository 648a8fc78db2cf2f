// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/method_rows.h"

#include <algorithm>
#include <set>

#include "core/contains.h"
#include "core/error.h"
#include "core/list_of.h"
#include "score/height_score.h"

namespace plotscan::farmbench {

std::vector<MethodHeight> rows_of(const std::string& method,
                                  const std::vector<std::string>& heights) {
  const std::size_t end = std::min(method.find(' '), method.size());  // of its first word
  return list_of(heights, [&](const std::string& height) {
    return MethodHeight{height, method.substr(0, end) + "/" + height + method.substr(end)};
  });
}

std::vector<MethodHeight> heights_of(const SuiteResult& result, const std::string& method) {
  if (!contains(result.entered, method)) return method_named(method).heights;
  std::set<std::string> names;
  for (const FarmResult& farm : result.farms) {
    for (const MethodResult& run : farm.methods)
      if (run.method == method) names.merge(score::estimated_heights(run.score));
  }
  if (names.empty()) return {{"", method}};
  return rows_of(method, {names.begin(), names.end()});
}

void require_methods(const SuiteResult& result) {
  for (const std::string& method : result.methods) {
    if (contains(result.entered, method)) continue;
    method_named(method);  // throws where it is not known
    if (std::ranges::count(result.methods, method) > 1)
      throw InputError("the method \"" + method + "\" is named twice");
  }
}

}  // namespace plotscan::farmbench
