// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// Adds `lidarsim convert IN OUT`.
void declare_convert(Program& program);

}  // namespace plotscan
