// SPDX-License-Identifier: Apache-2.0
#include "core/json_text.h"

#include "core/error.h"

namespace plotscan {

std::string read_json_text(const std::filesystem::path& path) {
  constexpr int kDeepest = 100;
  std::string text = read_text(path);
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quoted && text[i] == '\\')
      ++i;  // skips the escaped character: a quote there ends no text
    else if (text[i] == '"')
      quoted = !quoted;
    else if (!quoted && (text[i] == '[' || text[i] == '{'))
      ++depth;
    else if (!quoted && (text[i] == ']' || text[i] == '}'))
      --depth;
    if (depth > kDeepest) throw InputError(path, "is nested deeper than {}", kDeepest);
  }
  return text;
}

std::string json_reason(const nlohmann::json::exception& error) {
  const std::string what = error.what();  // "[json.exception.parse_error.101] parse error at ..."
  return what.substr(what.find("] ") + 2);
}

nlohmann::json read_json(const std::filesystem::path& path) {
  try {
    return nlohmann::json::parse(read_json_text(path));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path, "not JSON: {}", json_reason(error));
  }
}

}  // namespace plotscan
