// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan {

// Standard acceleration of gravity (3rd CGPM, 1901).
inline constexpr double kGravity_m_s2 = 9.80665;

}  // namespace plotscan
