// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/solver.h"

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "dense_normal.h"
#include "random_fields.h"

namespace plotscan::ground {
namespace {

constexpr SolveOptions kToTheEnd{.most_iterations = 2000, .tolerance_m = 1e-7};

Fit random_fit(const Grid& grid) {
  return {.target = random_field(grid, "test/target", -1, 1),
          .data = random_field(grid, "test/data", 0.2, 3),
          .stiffness = random_field(grid, "test/stiffness", 0.1, 5)};
}

TEST(Solve, AgreesWithADenseFactorisation) {
  for (const Grid& grid :
       {Grid{.cell_m = 0.2, .columns = 9, .rows = 7}, Grid{.cell_m = 0.2, .columns = 3, .rows = 14},
        Grid{.cell_m = 0.2, .columns = 21, .rows = 3}}) {
    const Fit fit = random_fit(grid);
    const Eigen::VectorXd right = vector_of(fit.data).array() * vector_of(fit.target).array();
    const Eigen::VectorXd best = dense_normal(grid, fit).ldlt().solve(right);
    Field surface(grid.nodes(), 0);
    solve(grid, fit, kToTheEnd, surface);
    EXPECT_LT((vector_of(surface) - best).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST(Solve, TakesAnotherRightHandSide) {
  const Grid grid{.cell_m = 0.2, .columns = 8, .rows = 8};
  const Fit fit = random_fit(grid);
  const Field right = random_field(grid, "test/right", -2, 2);
  const Eigen::VectorXd best = dense_normal(grid, fit).ldlt().solve(vector_of(right));
  Field surface = random_field(grid, "test/start", -1, 1);
  solve_right_side(grid, fit, right, kToTheEnd, surface);
  EXPECT_LT((vector_of(surface) - best).cwiseAbs().maxCoeff(), 1e-4);
}

// A plane has no second differences, so it passes through data that lie in it, however stiff.
TEST(Solve, GoesOnAsAPlaneWhereNothingIsKnown) {
  const Grid grid{.cell_m = 0.2, .columns = 12, .rows = 10};
  const auto plane = [](int c, int r) { return 0.3 + 0.02 * c - 0.05 * r; };
  Fit fit{.target = field_of(grid, plane),
          .data = Field(grid.nodes(), 0),
          .stiffness = Field(grid.nodes(), 50)};
  for (const auto& [c, r] : {std::array{1, 1}, std::array{9, 2}, std::array{3, 8}})
    fit.data[grid.index(c, r)] = 100;
  Field surface(grid.nodes(), 0);
  solve(grid, fit, kToTheEnd, surface);
  for (std::size_t i = 0; i < grid.nodes(); ++i)
    EXPECT_NEAR(surface[i], fit.target[i], 1e-3) << "node " << i;
}

TEST(Solve, LeavesASurfaceThatFits) {
  const Grid grid{.cell_m = 0.2, .columns = 6, .rows = 6};
  const Fit fit{.target = Field(grid.nodes(), 0),
                .data = Field(grid.nodes(), 1),
                .stiffness = Field(grid.nodes(), 1)};
  Field surface(grid.nodes(), 0);
  EXPECT_EQ(solve(grid, fit, SolveOptions(), surface), 0);
  EXPECT_EQ(surface, Field(grid.nodes(), 0));
}

TEST(Solve, GivesTheSameBytesForAnyNumberOfThreads) {
  const Grid grid{.cell_m = 0.2, .columns = 250, .rows = 180};
  const Fit fit = random_fit(grid);
  const auto solved = [&](int threads) {
    Field surface(grid.nodes(), 0);
    tbb::task_arena(threads).execute([&] { solve(grid, fit, SolveOptions(), surface); });
    return surface;
  };
  const Field one = solved(1);
  EXPECT_EQ(one, solved(2));
  EXPECT_EQ(one, solved(3));
}

// z = a x^2 + b y^2 + c x y has the second derivatives 2a, 2b and c everywhere.
TEST(Curvature, IsThatOfAQuadric) {
  const Grid grid{.cell_m = 0.2, .columns = 7, .rows = 5};
  const double a = 0.03, b = -0.02, c = 0.05;
  const Field quadric =
      field_of(grid, [&](int x, int y) { return a * x * x + b * y * y + c * x * y; });
  const double bend = std::sqrt(4 * a * a + 4 * b * b + 2 * c * c);
  for (const float here : curvature(grid, quadric)) EXPECT_NEAR(here, bend, 1e-5);
}

}  // namespace
}  // namespace plotscan::ground
