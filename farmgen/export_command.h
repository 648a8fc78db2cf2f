// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

// Adds `farmgen export`.
void add_export_command(plotscan::Program& program);
