// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground/columns.h"
#include "ground/grid.h"

namespace plotscan::ground {

// Evidence for the ground at each node from the returns near a surface.
struct Evidence {
  Field target_m;  // where the ground returns put the node
  Field data;      // 1 / m^2: the precision of that; 0 where no return supports it
  Field doubt_m;   // standard error that the canopy's unknown shape near the ground adds to it
  Field support;   // 0 to 1: how far the peak of ground stands out of the canopy around
};

// One step of expectation and maximisation over the returns near the surface: ground N(0, noise)
// against a canopy that lies above it, with shares that hold for about a square metre around.
Evidence weigh(const Columns& columns, const Field& surface, double noise_m);

}  // namespace plotscan::ground
