// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "core/csv.h"
#include "core/random.h"

namespace plotscan::strata {

using Bounds = std::pair<double, double>;

inline double draw(RandomStream& random, const Bounds& range) {
  return random.uniform(range.first, range.second);
}

// A whole number in [low, high].
inline int draw_count(RandomStream& random, int low, int high) {
  const auto count = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) + 1;
  return low + static_cast<int>(random.below(count));
}

template <class Value, std::size_t Count>
Value pick(RandomStream& random, const std::array<Value, Count>& values) {
  return values[random.below(Count)];
}

inline bool chance(RandomStream& random, double share) { return random.uniform() < share; }

// To a tenth of a millimetre: descriptions that a person can read.
inline std::string text(double value) { return format_number(std::round(value * 1e4) / 1e4); }

}  // namespace plotscan::strata
