// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <initializer_list>
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

// The parts of the text between the separators: one more than there are of these.
inline std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

// The text without the blanks at its ends.
inline std::string_view without_blanks(std::string_view text, std::string_view blanks = " \t\r") {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// The text with another in place of each of these characters, as formats escape them.
inline std::string with_escapes(
    std::string_view text, std::initializer_list<std::pair<char, std::string_view>> in_place_of) {
  std::string written;
  for (const char c : text) {
    const auto* const found =
        std::ranges::find(in_place_of, c, [](const auto& e) { return e.first; });
    written += found == in_place_of.end() ? std::string_view(&c, 1) : found->second;
  }
  return written;
}

// The text in quotes, as messages show it; as it is where it has its own.
inline std::string in_quotes(std::string_view text) {
  const std::string quote = text.starts_with('"') ? "" : "\"";
  return quote + std::string(text) + quote;
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
