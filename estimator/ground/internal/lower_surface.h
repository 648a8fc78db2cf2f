// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground/columns.h"
#include "ground/grid.h"

namespace plotscan::ground {

// The highest surface under z that is nowhere steeper than `slope`; infinite z bound nothing. Two
// sweeps of a chamfer distance (Borgefors, 1986).
Field slope_limited(const Grid& grid, const Field& z, double slope);

// The lowest layer of returns in each column.
struct Layer {
  Field z_m;      // its height at the node; infinite where there is no return
  Field weight;   // 0 to 1: how much it stands out of what lies right above it
  Field returns;  // how many make it
  Field scatter;  // mean square of their distances from it, m^2
};

// The lowest layer of columns that are not tilted, for use before a surface gives their tilt.
Layer upright_layer(const Columns& columns, double noise_m);

// A first surface that follows the lowest returns; it lies within a few sigma of the ground where
// ground is seen (docs/ground.md, step 4). Metres above the columns' base.
Field lower_surface(const Columns& columns, const Layer& upright, double noise_m);

// A surface through the lowest layers wherever these are, canopy or ground: it follows ridges that
// the lower surface cuts off, and climbs canopies that are closed.
struct LayerSurface {
  Field z_m;
  Layer layer;  // that it goes through; without strays below
};
LayerSurface layer_surface(const Columns& columns, const Layer& upright, double noise_m);

}  // namespace plotscan::ground
