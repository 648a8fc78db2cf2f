// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground/grid.h"
#include "ground/internal/mixture.h"
#include "ground/surface.h"

namespace plotscan::ground {

// Draws of the surface's error (docs/ground.md, step 7): from the normal distribution, given this
// evidence, of a surface whose second differences are white noise, as large as they are where the
// ground is seen. `surface` is in metres above any plane.
ErrorDraws draw_errors(const Grid& grid, const Field& surface, const Evidence& evidence,
                       double noise_m);

// Root mean square of the draws at every node of the grid, metres.
Field spread_of(const Grid& grid, const ErrorDraws& errors);

}  // namespace plotscan::ground
