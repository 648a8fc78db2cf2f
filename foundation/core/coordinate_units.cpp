// SPDX-License-Identifier: Apache-2.0
#include "core/coordinate_units.h"

#include <cmath>

#include "core/csv.h"

namespace plotscan {

std::string unit_name(double unit_m) {
  if (unit_m == 1) return "metres";
  if (unit_m == kFoot_m) return "feet";
  if (unit_m == kUsSurveyFoot_m) return "US survey feet";
  return "units of " + format_number(unit_m) + " m";
}

std::optional<double> unit_named(const std::string& name) {
  if (name == "m") return 1;
  if (name == "ft") return kFoot_m;
  if (name == "us-ft") return kUsSurveyFoot_m;
  return std::nullopt;
}

double exact_unit(double unit_m) {
  // Small enough to tell the two feet apart, whose lengths differ by a share of 2e-6.
  constexpr double kTolerance = 3e-7;
  for (const double known : {1.0, kFoot_m, kUsSurveyFoot_m})
    if (std::abs(unit_m / known - 1) < kTolerance) return known;
  return unit_m;
}

}  // namespace plotscan
