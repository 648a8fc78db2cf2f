// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

// Each adds the command of its name to `farmgen`; the others are in main.cpp.
namespace plotscan {

void declare_export(Program& program);
void declare_plant(Program& program);

}  // namespace plotscan
