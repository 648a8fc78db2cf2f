// SPDX-License-Identifier: Apache-2.0
#include "sensor/return_mode.h"

#include <algorithm>
#include <array>

namespace plotscan::sensor {

const std::vector<std::string>& return_mode_names() {
  static const std::vector<std::string> names = {"strongest", "last", "dual"};
  return names;
}

std::optional<ReturnMode> return_mode(const std::string& name) {
  constexpr std::array kModes = {ReturnMode::strongest, ReturnMode::last, ReturnMode::dual};
  const auto& names = return_mode_names();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return kModes[static_cast<std::size_t>(found - names.begin())];
}

}  // namespace plotscan::sensor
