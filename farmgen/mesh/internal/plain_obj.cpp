// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "mesh/internal/assimp_mesh.h"

namespace plotscan::mesh {
namespace {

constexpr std::string_view kBlanks = " \t\r";

bool is_geometry(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(kBlanks);
  return begin != std::string_view::npos && (line[begin] == 'v' || line[begin] == 'f');
}

bool begins_number(char before) {
  return kBlanks.find(before) != std::string_view::npos || before == '-' || before == '+';
}

void append_geometry(std::string_view line, std::string& text) {
  char before = '\0';
  for (const char at : line.substr(0, line.find('#'))) {
    if (at == '.' && begins_number(before)) text += '0';
    text += at;
    before = at;
  }
}

}  // namespace

std::string plain_obj(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    if (is_geometry(line))
      append_geometry(line, plain);
    else
      plain += line;
    if (end < text.size()) plain += '\n';
    begin = end + 1;
  }
  return plain;
}

}  // namespace plotscan::mesh
