// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace plotscan {

inline constexpr double kPi = std::numbers::pi;
// In radians: 30 * kDegrees.
inline constexpr double kDegrees = kPi / 180;

}  // namespace plotscan
