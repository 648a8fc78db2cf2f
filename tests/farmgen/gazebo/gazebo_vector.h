// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <ignition/math/Vector3.hh>

namespace plotscan::gazebo {

inline Eigen::Vector3d eigen(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

}  // namespace plotscan::gazebo
