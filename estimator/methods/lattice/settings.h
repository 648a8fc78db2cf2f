// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/method_setting.h"
#include "methods/lattice/lattice.h"

namespace plotscan::methods::lattice {

// Every option of the method that a user may set.
const std::vector<MethodSetting<Options>>& settings();

}  // namespace plotscan::methods::lattice
