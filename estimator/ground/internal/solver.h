// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground/grid.h"

namespace plotscan::ground {

// What a surface s over the grid has to be near, and how stiff it is:
//   sum of data (s - target)^2 + sum of stiffness |second differences of s|^2
// over the nodes; |.|^2 is the squared Frobenius norm of the Hessian (xx, yy, and twice xy, the
// latter in the middle of four nodes with the mean of their stiffnesses), in metres a cell^2.
struct Fit {
  Field target = {};     // metres
  Field data = {};       // 1 / m^2; 0 where nothing is known
  Field stiffness = {};  // 1 / m^2
};

struct SolveOptions {
  int most_iterations = 200;
  double tolerance_m = 2e-4;  // stops when the last steps move no node's mean square by more
};

// Minimises the above by conjugate gradients (Hestenes and Stiefel, 1952) with the diagonal as
// preconditioner, starting from `surface`. Returns the number of iterations.
int solve(const Grid& grid, const Fit& fit, const SolveOptions& options, Field& surface);

// The same for another right-hand side than data * target.
int solve_right_side(const Grid& grid, const Fit& fit, const Field& right,
                     const SolveOptions& options, Field& surface);

// Stiffness in the middle of four nodes, of which i is the lower left one.
float middle_stiffness(const Grid& grid, const Field& stiffness, std::size_t i);

// sqrt(xx^2 + yy^2 + 2 xy^2) at each node, metres a cell^2.
Field curvature(const Grid& grid, const Field& surface);

}  // namespace plotscan::ground
