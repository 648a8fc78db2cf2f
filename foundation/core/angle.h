// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace plotscan {

inline constexpr double kPi = std::numbers::pi;
// One degree in radians: 30 * kDegrees is an angle of 30 degrees. Its last bit may differ from that
// of radians(30).
inline constexpr double kDegrees = kPi / 180;

constexpr double radians(double angle_deg) { return angle_deg * kPi / 180; }
constexpr double degrees(double angle_rad) { return angle_rad * 180 / kPi; }

}  // namespace plotscan
