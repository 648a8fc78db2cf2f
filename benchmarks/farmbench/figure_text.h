// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include <fmt/core.h>

#include "core/number_text.h"
#include "farmbench/results_table.h"

// Figures as tables show them.
namespace plotscan::farmbench {

// "1 farm", "3 farms".
inline std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

// A length as centimetres with two decimals; "-" for NaN.
inline std::string centimetres(double metres) { return cell("{:.2f}", 100 * metres); }

// A share as a percentage with one decimal; "-" for NaN.
inline std::string percent(double share) { return cell("{:.1f} %", 100 * share); }

// How many errors of more than 5 cm come without a flag: "3 (0.33 %)".
inline std::string unflagged(const TableRow& row) {
  return std::to_string(row.height.large_unflagged) + " (" +
         cell("{:.2f} %", 100 * row.height.large_unflagged_share) + ")";
}

// "4.81 [4.40, 5.30]", without the interval where it is NaN.
inline std::string with_interval(double metres, const Interval& ends_m) {
  if (std::isnan(ends_m.low)) return centimetres(metres);
  return fmt::format("{} [{}, {}]", centimetres(metres), centimetres(ends_m.low),
                     centimetres(ends_m.high));
}

}  // namespace plotscan::farmbench
