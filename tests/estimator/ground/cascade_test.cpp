// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/cascade.h"

#include <cstddef>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "dense_normal.h"
#include "random_fields.h"

namespace plotscan::ground {
namespace {

// Ground that is known in the west, seen from up to 12 nodes away in the east. From a level start,
// as many iterations of conjugate gradients leave most of the east as it was.
TEST(Cascade, ReachesWhatLiesFarFromAllData) {
  const Grid grid{.cell_m = 0.4, .columns = 24, .rows = 19};
  const Field noise = random_field(grid, "test/right", -800, 800);
  const auto in_the_west = [&](const auto& value) {
    return field_of(grid, [&](int column, int row) {
      return column < 12 ? value(grid.index(column, row)) : 0;
    });
  };
  const Fit fit{.target = {},
                .data = in_the_west([](std::size_t) { return 2000.0f; }),
                .stiffness = random_field(grid, "test/stiffness", 5000, 15000)};
  const Field right = in_the_west([&](std::size_t i) { return noise[i]; });
  const Eigen::VectorXd best = dense_normal(grid, fit).ldlt().solve(vector_of(right));
  const auto off = [&](const Field& surface) {
    return (vector_of(surface) - best).norm() / best.norm();
  };
  constexpr SolveOptions kFew{.most_iterations = 80, .tolerance_m = 1e-4};
  Field from_level(grid.nodes(), 0);
  solve_right_side(grid, fit, right, kFew, from_level);
  EXPECT_GT(off(from_level), 0.6);
  EXPECT_LT(off(Cascade(grid, fit).solve(right, kFew)), 0.3);
}

}  // namespace
}  // namespace plotscan::ground
