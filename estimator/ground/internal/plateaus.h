// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "ground/grid.h"

namespace plotscan::ground {

// 1 at the nodes whose lowest returns lie on top of something up to 6 m wide that stands out of its
// surroundings by a step on all sides: a canopy as photogrammetry sees it. No returns come from
// below such a top, so nothing in its own column tells it from ground. Progressive morphological
// filter (Zhang et al. 2003) of the lowest layers' heights `z_m`, infinite where there is no
// return. All are 0 in a cloud that has hardly any such tops.
std::vector<std::uint8_t> plateaus(const Grid& grid, const Field& z_m, double noise_m);

}  // namespace plotscan::ground
