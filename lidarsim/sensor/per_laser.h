// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Core>

#include "sensor/sensor.h"

namespace plotscan::sensor {

// One number a laser, in the order of firing; vectors are kept by component so that several lasers
// are worked on at once.
using PerLaser = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxLasers, 1>;
using VectorPerLaser = std::array<PerLaser, 3>;

}  // namespace plotscan::sensor
