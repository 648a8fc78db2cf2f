// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace plotscan {

// The number that the whole text writes, whatever the locale: decimal digits, a minus sign, and for
// floating-point numbers an exponent, "inf" or "nan". Absent where the text holds anything else, or
// more than the type does.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return value;
}

// A plus sign, which other programs write before numbers, is none that `parsed` takes.
inline std::string_view without_plus(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  return text;
}

}  // namespace plotscan
