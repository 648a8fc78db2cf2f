// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plotscan::cloud {

// An axis-parallel rectangle of the horizontal plane: x0, y0, x1, y1, world frame, metres. As
// options and manifests hold it.
using Area = std::array<double, 4>;

// float32 relative to the centre of the largest area, 10 km, resolves 0.5 mm.
inline constexpr double kLongestSide_m = 10000;

// The rectangle, and so far around it.
Area around(const Eigen::AlignedBox2d& rectangle, double margin_m = 0);

// Whether the place lies in the area, its edge included.
bool holds(const Area& area, const Eigen::Vector2d& place);

// Its sides along x and y, metres.
Eigen::Vector2d sides_of(const Area& area);
Eigen::Vector2d middle_of(const Area& area);

// Throws InputError naming `option` unless x0 < x1 and y0 < y1, all finite, and no side is over
// 10 km.
void require_area(const Area& area, const std::string& option);

// The same of the area that a cloud covers; the message says what to do.
void require_scanned_area(const Area& area, const std::string& cloud);

// "x0,y0,x1,y1".
std::string text_of(const Area& area);

}  // namespace plotscan::cloud
