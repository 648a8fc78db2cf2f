// SPDX-License-Identifier: Apache-2.0
#include "core/printable.h"

#include <cstdint>

#include <fmt/core.h>

#include "core/error.h"

namespace plotscan {
namespace {

// The number of bytes of the UTF-8 character at the beginning of the text; 0 if it is no valid one.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  // Invalid: encoded longer than needed, a surrogate, or beyond U+10FFFF.
  const std::uint8_t second = byte(1);
  const bool wrong = (lead == 0xe0 && second < 0xa0) || (lead == 0xed && second > 0x9f) ||
                     (lead == 0xf0 && second < 0x90) || (lead == 0xf4 && second > 0x8f);
  return wrong ? 0 : length;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

bool is_control(std::string_view character) {
  const auto lead = static_cast<std::uint8_t>(character[0]);
  if (character.size() == 1) return (lead < 0x20 && lead != '\n' && lead != '\t') || lead == 0x7f;
  return lead == 0xc2 && static_cast<std::uint8_t>(character[1]) < 0xa0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, length == 0 ? 1 : length);
    if (length > 0 && !is_control(character))
      shown += character;
    else
      for (const char byte : character) shown += fmt::format("\\x{:02x}", byte & 0xff);
    text.remove_prefix(character.size());
  }
  return shown;
}

std::string utf8_of(const std::string& text) {
  if (is_utf8(text)) return text;
  std::string encoded;
  for (const char c : text) {
    const auto byte = static_cast<std::uint8_t>(c);
    if (byte < 0x80) {
      encoded += c;
    } else {
      encoded += static_cast<char>(0xc0 | byte >> 6);
      encoded += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return encoded;
}

void require_utf8(std::string_view text, const std::filesystem::path& file) {
  std::size_t line = 1;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) throw InputError(file, line, "is no UTF-8 text; save it in that encoding");
    if (text.front() == '\n') ++line;
    text.remove_prefix(length);
  }
}

}  // namespace plotscan
