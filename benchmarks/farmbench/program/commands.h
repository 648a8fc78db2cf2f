// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

// Each adds commands to `farmbench`.
namespace plotscan {

void declare_run(Program& program);     // run, sweep, report
void declare_plan(Program& program);    // plan, farm, merge
void declare_export(Program& program);  // export
void declare_score(Program& program);   // score

// What --seed means to the commands that make tables.
inline constexpr const char* kTableSeed = "seed of the bootstrap that makes the table's intervals";

}  // namespace plotscan
