// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/random.h"

namespace plotscan::strata {

// The kinds of field in which there is no plot to be found: orchard, vines, cars, room, mound,
// building, bushes, bare, sheet (docs/benchmark.md).
const std::vector<std::string>& empty_kinds();

// The scan of a field of that kind, its sizes, spacings, heading, density and noise drawn. World
// frame, metres. `kind` is one of empty_kinds().
std::vector<Eigen::Vector3f> draw_empty_field(const std::string& kind, RandomStream& random);

}  // namespace plotscan::strata
