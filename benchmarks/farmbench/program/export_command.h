// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// Adds `farmbench export SUITE -o DIR`.
void declare_export(Program& program);

}  // namespace plotscan
