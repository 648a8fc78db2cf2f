// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plotscan::farmbench {

using Cells = std::vector<std::string>;

inline std::string markdown_row(const Cells& cells) {
  std::string line;
  for (const std::string& cell : cells) line += "| " + cell + " ";
  return line + "|\n";
}

inline std::string markdown_table(const Cells& heads, const std::vector<Cells>& rows) {
  std::string text = markdown_row(heads) + markdown_row(Cells(heads.size(), "---"));
  for (const Cells& cells : rows) text += markdown_row(cells);
  return text;
}

}  // namespace plotscan::farmbench
