// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include "core/text.h"

namespace plotscan::farmbench {

// A number in the format; "-" for NaN.
inline std::string number(const char* format, double value) {
  return std::isnan(value) ? "-" : formatted(format, value);
}

// A length as centimetres with two decimals; "-" for NaN.
inline std::string centimetres(double metres) { return number("%.2f", 100 * metres); }

// "4.81 [4.40, 5.30]", without the interval where it is NaN.
inline std::string with_interval(double metres, double low_m, double high_m) {
  const std::string value = centimetres(metres);
  return std::isnan(low_m) ? value
                           : value + " [" + centimetres(low_m) + ", " + centimetres(high_m) + "]";
}

}  // namespace plotscan::farmbench
