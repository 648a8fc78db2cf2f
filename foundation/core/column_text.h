// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include <fmt/core.h>

namespace plotscan {

// A number as a column of this width has it, to the right: with two decimals, with fewer digits
// where these would fill it ("-123457", "-4e+06"), a dash for NaN. `with_sign`: 0 and above have a
// plus.
inline std::string column_text(double value, std::size_t width, bool with_sign = false) {
  if (std::isnan(value)) return fmt::format("{:>{}}", "-", width);
  const std::string sign = with_sign && value >= 0 ? "+" : "";
  std::string text = sign + fmt::format("{:.2f}", value);
  if (text.size() >= width) text = sign + fmt::format("{:.0f}", value);
  if (text.size() >= width) text = sign + fmt::format("{:.0e}", value);
  return fmt::format("{:>{}}", text, width);
}

}  // namespace plotscan
