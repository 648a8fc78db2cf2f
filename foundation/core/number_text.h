// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <string>
#include <string_view>

#include <fmt/core.h>

namespace plotscan {

// The shortest text that reads back as the same number ("0.1", "1e-07"), kept in this object.
class NumberText {
 public:
  template <class Number>
  requires std::integral<Number> || std::floating_point<Number>
  explicit NumberText(Number value) {
    end_ = std::to_chars(text_.data(), text_.data() + text_.size(), value).ptr;
  }
  NumberText(const NumberText&) = delete;
  NumberText& operator=(const NumberText&) = delete;

  operator std::string_view() const { return {text_.data(), end_}; }

 private:
  std::array<char, 32> text_;
  const char* end_ = nullptr;
};

// A number in the format, as tables for people have it: "-" for NaN.
inline std::string cell(fmt::format_string<double&> format, double value) {
  return std::isnan(value) ? "-" : fmt::format(format, value);
}

}  // namespace plotscan
