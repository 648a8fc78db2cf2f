// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

// Default colours of surfaces whose meshes state none: diffuse red, green, blue.
namespace plotscan::farm {

inline const Eigen::Vector3f kLeafGreen(0.24F, 0.46F, 0.16F);
inline const Eigen::Vector3f kSoilBrown(0.45F, 0.34F, 0.24F);

}  // namespace plotscan::farm
