// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// Adds `lidarsim sensors [NAME|FILE.yaml]`.
void declare_sensors(Program& program);

}  // namespace plotscan
