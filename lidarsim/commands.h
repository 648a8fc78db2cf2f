// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

// Each adds a command to `lidarsim`; `fly` is in main.cpp.
namespace plotscan {

void declare_convert(Program& program);
void declare_join(Program& program);
void declare_sensors(Program& program);
void declare_view(Program& program);

}  // namespace plotscan
