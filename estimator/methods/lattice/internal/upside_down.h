// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Core>

namespace plotscan::methods::lattice {

// Whether z points down in a cloud (x, y, z in metres, `noise_m` the sigma of heights about bare
// ground): what is taller than one layer of returns hangs from the layers beside it instead of
// standing on them. False where too few such places are seen.
bool is_upside_down(std::span<const Eigen::Vector3f> points, double noise_m);

}  // namespace plotscan::methods::lattice
