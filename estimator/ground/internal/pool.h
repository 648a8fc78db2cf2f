// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground/grid.h"

namespace plotscan::ground {

// Makes every node's value the sum over the square of nodes that reaches `around` to either side.
void pool(const Grid& grid, int around, Field& field);

}  // namespace plotscan::ground
