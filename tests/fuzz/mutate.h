// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "fuzz/targets.h"

namespace plotscan::fuzz {

// A file like `bytes` with one branch of its tree changed: a value replaced by one that readers
// have to think of, a branch taken out, doubled, or put in the place of another. Nothing where the
// bytes are no such tree, or the structure has none.
std::optional<std::string> mutated(Structure structure, const std::string& bytes,
                                   std::uint32_t seed);

}  // namespace plotscan::fuzz
