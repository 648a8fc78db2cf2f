// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground/grid.h"
#include "ground/internal/lower_surface.h"
#include "ground/internal/mixture.h"

namespace plotscan::ground {

// A fitted surface and what it takes for its errors.
struct Fitted {
  const Field& z_m;  // counted as the layer's heights are
  const Evidence& evidence;
  const Field& sd_m;  // standard error of z_m that follows from the evidence and from how it bends
};

// Standard error at each node that the fit knows nothing of: a ground rougher than a surface
// through few returns, ditches that it passes over, vegetation and roofs that it climbed. No return
// comes from below the ground, so the layers that lie under the surface tell how wrong it is around
// them; those above it may be canopy, and tell as much where they lie as near as the others
// (docs/ground.md, step 7).
Field misfit(const Grid& grid, const Layer& layer, const Fitted& fitted);

}  // namespace plotscan::ground
