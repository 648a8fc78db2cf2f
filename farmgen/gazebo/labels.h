// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plotscan::gazebo {

// What a surface of an exported world is: its laser_retro, and its label for segmentation cameras.
// The numbers are those of scan::PointClass (lidarsim/scan/point.h), which this room cannot see.
enum class SurfaceClass : std::uint8_t { ground = 1, crop = 2, weed = 3, other = 4 };

}  // namespace plotscan::gazebo
