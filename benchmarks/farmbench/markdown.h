// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <fmt/ranges.h>

namespace plotscan::farmbench {

using Cells = std::vector<std::string>;

inline std::string markdown_table(const Cells& heads, std::vector<Cells> rows) {
  rows.insert(rows.begin(), {heads, Cells(heads.size(), "---")});
  std::string text;
  for (const Cells& cells : rows) text += fmt::format("| {} |\n", fmt::join(cells, " | "));
  return text;
}

}  // namespace plotscan::farmbench
