// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plotscan {

// The name that was probably meant: the fewest letters (Levenshtein) from the given one, at most a
// third of its length; nothing where none is so near.
std::optional<std::string> nearest_name(const std::string& given,
                                        const std::vector<std::string>& names);

}  // namespace plotscan
