// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace plotscan {

// The international foot, and the US survey foot of 1200/3937 m.
inline constexpr double kFoot_m = 0.3048;
inline constexpr double kUsSurveyFoot_m = 1200.0 / 3937.0;

// What coordinates of a file count in: metres to one unit of x and y, and to one of z.
struct CoordinateUnits {
  double horizontal_m = 1;
  double vertical_m = 1;
  bool operator==(const CoordinateUnits&) const = default;
};

// "metres", "feet", "US survey feet", or "units of 0.3 m".
std::string unit_name(double unit_m);

// Of "m", "ft" and "us-ft"; nothing for any other name.
std::optional<double> unit_named(const std::string& name);

// The foot that a file's rounded number means (files give it with 7 digits and more), else the
// number.
double exact_unit(double unit_m);

}  // namespace plotscan
