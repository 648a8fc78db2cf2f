// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "ground/grid.h"
#include "ground/internal/solver.h"

namespace plotscan::ground {

// Solves as solve_right_side does, from no surface: it starts from the solution on every second
// node, which starts from that on every fourth, and so on (cascadic multigrid; Bornemann and
// Deuflhard, Numer. Math. 75, 1996). Where nothing is known over many nodes, conjugate gradients
// alone take far more iterations.
class Cascade {
 public:
  Cascade(const Grid& grid, Fit fit);

  Field solve(const Field& right, const SolveOptions& options) const;

 private:
  struct Level {
    Grid grid;
    Fit fit;
  };
  std::vector<Level> levels_;  // the finest first
};

}  // namespace plotscan::ground
