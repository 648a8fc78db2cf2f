// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// Adds `farmbench score SUBMISSION --suite SUITE`.
void declare_score(Program& program);

}  // namespace plotscan
