// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground/grid.h"
#include "ground/internal/solver.h"

namespace plotscan::ground {

// Solves as solve_right_side does. It starts from the solution on every second node, which starts
// from that on every fourth, and so on (cascadic multigrid; Bornemann and Deuflhard, Numer. Math.
// 75, 1996). Where nothing is known over many nodes, conjugate gradients alone take far more
// iterations.
Field solve_by_cascade(const Grid& grid, const Fit& fit, const Field& right,
                       const SolveOptions& options);

}  // namespace plotscan::ground
