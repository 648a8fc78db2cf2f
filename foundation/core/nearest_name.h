// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plotscan {

// The name that the user probably meant: the one with the smallest Levenshtein distance to the
// given name, at most a third of its length; absent if none is so near.
std::optional<std::string> nearest_name(const std::string& given,
                                        const std::vector<std::string>& names);

}  // namespace plotscan
