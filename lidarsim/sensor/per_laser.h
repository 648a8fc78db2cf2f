// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Core>

#include "sensor/sensor.h"

namespace plotscan::sensor {

// One number per laser, in the order of firing. Vectors are stored by component, so that several
// lasers are computed at once.
using PerLaser = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxLasers, 1>;
using VectorPerLaser = std::array<PerLaser, 3>;

}  // namespace plotscan::sensor
