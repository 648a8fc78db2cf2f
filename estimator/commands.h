// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

// Each adds the command of its name to `estimator`.
namespace plotscan {

void declare_run(Program& program);
void declare_info(Program& program);
void declare_score(Program& program);
void declare_report(Program& program);

}  // namespace plotscan
