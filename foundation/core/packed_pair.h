// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>

namespace plotscan {

// Two whole numbers as one, for maps and lists of a grid's cells: the first in the upper 32 bits.
constexpr std::uint64_t packed_pair(std::int32_t first, std::int32_t second) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(first)) << 32 |
         static_cast<std::uint32_t>(second);
}
constexpr std::pair<std::int32_t, std::int32_t> unpacked_pair(std::uint64_t key) {
  return {static_cast<std::int32_t>(key >> 32), static_cast<std::int32_t>(key)};
}

}  // namespace plotscan
