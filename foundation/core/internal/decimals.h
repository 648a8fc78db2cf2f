// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <nlohmann/json.hpp>

namespace plotscan {

// The most decimals that any position of a map in degrees has, where these are at most 6: 1e-6
// degrees are 11 cm. Absent where a position has more, or there is none.
std::optional<int> few_decimals_of(const nlohmann::json& map);

}  // namespace plotscan
