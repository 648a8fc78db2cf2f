// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farm/surface_class.h"

namespace plotscan::gazebo {

using farm::class_of;
using farm::SurfaceClass;

}  // namespace plotscan::gazebo
