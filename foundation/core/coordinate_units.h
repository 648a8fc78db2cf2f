// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plotscan {

// The international foot, and the US survey foot of 1200/3937 m.
inline constexpr double kFoot_m = 0.3048;
inline constexpr double kUsSurveyFoot_m = 1200.0 / 3937.0;

// The units of a file's coordinates: how many metres one unit of x and y is, and one unit of z.
struct CoordinateUnits {
  double horizontal_m = 1;
  double vertical_m = 1;
  bool operator==(const CoordinateUnits&) const = default;
};

// What units are called in options: m, cm, mm (phenotyping platforms over a bench or a field), ft
// and us-ft.
std::vector<std::string> unit_symbols();

// Metres in the unit of that symbol; absent for any other name.
std::optional<double> unit_named(const std::string& symbol);

// "metres", "millimetres", "US survey feet", or "units of 0.3 m".
std::string unit_name(double unit_m);

// The exact length of the named unit that a file's rounded number stands for (files give 7 digits
// and more); any other number as it is.
double exact_unit(double unit_m);

}  // namespace plotscan
