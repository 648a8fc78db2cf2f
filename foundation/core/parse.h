// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace plotscan {

// The number that the whole text stands for, in any locale: decimal digits, a minus sign, and for
// floating-point numbers an exponent, "inf" or "nan". Absent if the text holds anything else, or
// the number does not fit the type.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return value;
}

// The text without a leading plus sign, which other programs write and `parsed` does not accept.
inline std::string_view without_plus(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  return text;
}

}  // namespace plotscan
