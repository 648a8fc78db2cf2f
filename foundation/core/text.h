// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plotscan {

// The names with the separator between them.
inline std::string joined(const std::vector<std::string>& names, const char* separator) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
  return text;
}

// The text with its ASCII letters in lower case.
inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

// The text without the mark that some editors put in front of UTF-8.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

// The file's extension in lower case, with its dot: ".las" of "FIELD.LAS".
inline std::string lower_extension(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

// "a, b or c"
inline std::string alternatives(std::vector<std::string> names) {
  if (names.size() < 2) return joined(names, "");
  const std::string last = std::move(names.back());
  names.pop_back();
  return joined(names, ", ") + " or " + last;
}

}  // namespace plotscan
