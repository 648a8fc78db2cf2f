// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/method_setting.h"
#include "methods/dhami2020/dhami2020.h"

namespace plotscan::methods::dhami2020 {

// Every option of the method that a user may set.
const std::vector<MethodSetting<Options>>& settings();

}  // namespace plotscan::methods::dhami2020
