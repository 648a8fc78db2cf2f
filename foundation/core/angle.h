// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace plotscan {

// In radians: 30 * kDegrees.
inline constexpr double kDegrees = std::numbers::pi / 180;

}  // namespace plotscan
