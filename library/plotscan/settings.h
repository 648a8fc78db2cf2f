// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace plotscan {

// A number (also for whole ones), yes or no, a text, or a list: three numbers of a mount, four of a
// rectangle.
using SettingValue = std::variant<double, bool, std::string, std::vector<double>>;

// One setting of a flight or of a method, as the programs' --help and suites know it.
struct Setting {
  std::string key;                         // "altitude_m"
  std::string help;                        // unit, range, meaning
  std::optional<SettingValue> usual = {};  // where it is not set; absent: found or another's own
  std::vector<std::string> choices = {};   // of a text; empty: any
};

}  // namespace plotscan
