// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace plotscan::cloud {

// What became of every point, of an estimate's diagnostics: "25408 read = 25131 used + 25 withheld
// or noise + 252 outside the field". What is 0 is not named.
std::string point_account(const nlohmann::json& diagnostics);

}  // namespace plotscan::cloud
