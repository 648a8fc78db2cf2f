// SPDX-License-Identifier: Apache-2.0
#include "farmbench/entry/command_line.h"

#include <algorithm>

#include "core/error.h"
#include "core/list_of.h"
#include "core/text.h"

namespace plotscan::farmbench {
namespace {

std::string places_of(const std::map<std::string, std::string>& values) {
  return joined(list_of(values, [](const auto& value) { return "{" + value.first + "}"; }), ", ");
}

std::string filled_in(const std::string& word, const std::map<std::string, std::string>& values) {
  std::string text;
  for (std::size_t at = 0; at < word.size();) {
    if (word[at] != '{') {
      text += word[at++];
    } else if (word.compare(at, 2, "{{") == 0) {
      text += '{';
      at += 2;
    } else {
      const std::size_t end = word.find('}', at);
      const std::string name = end == std::string::npos ? "" : word.substr(at + 1, end - at - 1);
      const auto value = values.find(name);
      if (value == values.end())
        throw InputError("the command's \"" + word.substr(at) + "\" names none of " +
                         places_of(values) + " (a brace itself is written {{)");
      text += value->second;
      at = end + 1;
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> split_command(const std::string& command) {
  std::vector<std::string> words;
  bool in_word = false;
  char quote = 0;
  for (const char c : command) {
    const bool is_blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (quote != 0) {
      if (c == quote)
        quote = 0;
      else
        words.back() += c;
    } else if (is_blank) {
      in_word = false;
    } else {
      if (!in_word) words.emplace_back();
      in_word = true;
      if (c == '"' || c == '\'')
        quote = c;
      else
        words.back() += c;
    }
  }
  if (quote != 0) throw InputError(std::string("the command's quote ") + quote + " has no end");
  if (words.empty() || words.front().empty()) throw InputError("the command has no program");
  return words;
}

std::vector<std::string> substituted(const std::vector<std::string>& words,
                                     const std::map<std::string, std::string>& values) {
  return list_of(words, [&](const std::string& word) { return filled_in(word, values); });
}

bool names_place(const std::vector<std::string>& words, const std::string& name) {
  return std::ranges::any_of(words, [&](const std::string& word) {
    return word.find("{" + name + "}") != std::string::npos;
  });
}

}  // namespace plotscan::farmbench
