// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// Adds `farmbench run SUITE -o DIR`, `farmbench sweep SWEEP -o DIR` and `farmbench report DIR`.
void declare_run(Program& program);

}  // namespace plotscan
