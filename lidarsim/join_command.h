// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// Adds `lidarsim join PART... -o SCAN`.
void declare_join(Program& program);

}  // namespace plotscan
