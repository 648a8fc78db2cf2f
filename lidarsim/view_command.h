// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// Adds `lidarsim view SCAN -o PAGE`.
void declare_view(Program& program);

}  // namespace plotscan
