// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// Adds `farmbench plan SUITE -o RESULTS`, `farmbench farm RESULTS FARM` and `farmbench merge
// RESULTS`.
void declare_plan(Program& program);

}  // namespace plotscan
