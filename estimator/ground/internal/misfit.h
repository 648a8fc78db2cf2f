// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground/grid.h"
#include "ground/internal/lower_surface.h"
#include "ground/internal/mixture.h"

namespace plotscan::ground {

// A fitted surface and its own estimate of its errors.
struct Fitted {
  const Field& z_m;  // counted as the layer's heights are
  const Evidence& evidence;
  const Field& sd_m;  // standard error of z_m that follows from the evidence and from how it bends
};

// Standard error at each node, metres, from causes that the fit cannot know: ground rougher than a
// surface through few returns, ditches that the surface crosses, vegetation and roofs that it
// climbs. No return comes from below the ground, so layers under the surface show its error around
// them; layers above it may be canopy, and count only where they lie as near as the others
// (docs/ground.md, step 8).
Field misfit(const Grid& grid, const Layer& layer, const Fitted& fitted);

}  // namespace plotscan::ground
