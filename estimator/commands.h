// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

// Each adds the command of its name to `estimator`.
namespace plotscan {

void declare_run(Program& program);
void declare_info(Program& program);
void declare_score(Program& program);
void declare_series(Program& program);
void declare_report(Program& program);

// The option --id of those that take a table of measured heights.
inline constexpr const char* kIdOfMeasured =
    "column of that table with the plots' ids (default: plot_number, plot_id or another usual "
    "name)";

}  // namespace plotscan
