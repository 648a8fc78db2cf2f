// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// Adds `estimator report EST -o PAGE`.
void declare_report(Program& program);

}  // namespace plotscan
