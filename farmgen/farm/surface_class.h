// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "farm/farm.h"

namespace plotscan::farm {

// What a surface of a world is: the <laser_retro> of its visual, in a farm's own world.sdf and in
// exported worlds, and its label for segmentation cameras. The numbers are those of
// scan::PointClass (lidarsim/scan/point.h), which this room cannot see.
enum class SurfaceClass : std::uint8_t { ground = 1, crop = 2, weed = 3, other = 4 };

inline SurfaceClass class_of(PlantKind kind) {
  return kind == PlantKind::weed ? SurfaceClass::weed : SurfaceClass::crop;
}

// The class of each model: that of its first plant; crop where it has no plant.
std::vector<SurfaceClass> classes_of_models(const Farm& farm);

}  // namespace plotscan::farm
