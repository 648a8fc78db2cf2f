// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace plotscan {

// The names with the separator between them.
inline std::string joined(const std::vector<std::string>& names, const char* separator) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
  return text;
}

// "a, b or c"
inline std::string alternatives(std::vector<std::string> names) {
  if (names.size() < 2) return joined(names, "");
  const std::string last = std::move(names.back());
  names.pop_back();
  return joined(names, ", ") + " or " + last;
}

}  // namespace plotscan
