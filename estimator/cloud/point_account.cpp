// SPDX-License-Identifier: Apache-2.0
#include "cloud/point_account.h"

#include <array>
#include <cstdint>
#include <utility>

namespace plotscan::cloud {

std::string point_account(const nlohmann::json& diagnostics) {
  constexpr std::array<std::pair<const char*, const char*>, 8> kFates = {
      {{"not_finite", "without a finite place"},
       {"marked", "withheld or noise"},
       {"left_out", "of classes left out"},
       {"outside", "outside the field"},
       {"repeated", "repeated"},
       {"thinned", "thinned"},
       {"outliers", "neither ground nor crop"},
       {"without_ground", "where the ground is unknown"}}};
  const auto read = diagnostics.at("points_read").get<std::uint64_t>();
  const auto used = diagnostics.at("points_in_area").get<std::uint64_t>() -
                    diagnostics.value("without_ground", std::uint64_t{0});
  std::string text = std::to_string(read) + " read = " + std::to_string(used) + " used";
  for (const auto& [name, fate] : kFates) {
    const auto count = diagnostics.value(name, std::uint64_t{0});
    if (count > 0) text += " + " + std::to_string(count) + " " + fate;
  }
  return text;
}

}  // namespace plotscan::cloud
