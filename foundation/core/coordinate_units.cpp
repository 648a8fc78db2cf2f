// SPDX-License-Identifier: Apache-2.0
#include "core/coordinate_units.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/csv.h"
#include "core/list_of.h"

namespace plotscan {
namespace {

struct NamedUnit {
  const char* symbol;
  const char* plural;
  double length_m;
};

constexpr std::array<NamedUnit, 5> kNamedUnits = {{{"m", "metres", 1},
                                                   {"cm", "centimetres", 0.01},
                                                   {"mm", "millimetres", 0.001},
                                                   {"ft", "feet", kFoot_m},
                                                   {"us-ft", "US survey feet", kUsSurveyFoot_m}}};

}  // namespace

std::vector<std::string> unit_symbols() {
  return list_of<std::string>(kNamedUnits, &NamedUnit::symbol);
}

std::optional<double> unit_named(const std::string& symbol) {
  const auto* const unit = std::ranges::find(kNamedUnits, symbol, &NamedUnit::symbol);
  if (unit == kNamedUnits.end()) return std::nullopt;
  return unit->length_m;
}

std::string unit_name(double unit_m) {
  const auto* const unit = std::ranges::find(kNamedUnits, unit_m, &NamedUnit::length_m);
  return unit != kNamedUnits.end() ? unit->plural : "units of " + format_number(unit_m) + " m";
}

double exact_unit(double unit_m) {
  // Small enough to tell the two feet apart, whose lengths differ by a share of 2e-6.
  constexpr double kTolerance = 3e-7;
  const auto* const unit = std::ranges::find_if(kNamedUnits, [unit_m](const NamedUnit& known) {
    return std::abs(unit_m / known.length_m - 1) < kTolerance;
  });
  return unit != kNamedUnits.end() ? unit->length_m : unit_m;
}

}  // namespace plotscan
