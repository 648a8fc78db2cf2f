// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/program.h"

namespace plotscan {

// `farmgen plant CROP ... -o MESH.obj`: grows one plant.
void add_plant_command(Program& program);

}  // namespace plotscan
