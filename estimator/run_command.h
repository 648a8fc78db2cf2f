// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// Adds `estimator run`.
void declare_run(Program& program);

}  // namespace plotscan
