// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// `estimator info CLOUD`.
void declare_info(Program& program);

}  // namespace plotscan
