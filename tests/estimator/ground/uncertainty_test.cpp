// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "dense_normal.h"
#include "random_fields.h"

namespace plotscan::ground {
namespace {

constexpr double kNoise_m = 0.02;
constexpr double kBend_m = 0.01;  // second difference along x between nodes of the draws' grid

const Grid kFine{.cell_m = 0.2, .columns = 32, .rows = 28};

// A parabola, whose bends are the same everywhere.
Field parabola() {
  return field_of(kFine, [](int column, int) { return kBend_m / 8 * column * column; });
}

// Ground that is seen with such a precision, 1 / m^2, in the western half only.
Evidence seen_in_the_west(float precision) {
  Evidence evidence{.target_m = parabola(),
                    .data = Field(kFine.nodes(), 0),
                    .doubt_m = Field(kFine.nodes(), 0),
                    .support = Field(kFine.nodes(), 1)};
  for (std::size_t i = 0; i < kFine.nodes(); ++i)
    if (i % kFine.columns < 16u) evidence.data[i] = precision;
  return evidence;
}

// The draws' squares, over many nodes, have the mean of the variances that the inverse of the
// normal equations gives: those of a surface with bends as large as the parabola's, given the
// evidence of four nodes at each of the draws' nodes.
TEST(DrawErrors, AreDistributedAsTheInverseOfTheNormalEquations) {
  const float precision = 500;
  const ErrorDraws errors = draw_errors(kFine, parabola(), seen_in_the_west(precision), kNoise_m);
  ASSERT_EQ(errors.grid.columns, 16);
  ASSERT_EQ(errors.grid.rows, 14);
  const Grid coarse{.cell_m = 0.4, .columns = 16, .rows = 14};
  const Fit fit{.target = {},
                .data = field_of(coarse, [&](int c, int) { return c < 8 ? 4 * precision : 0; }),
                .stiffness = Field(coarse.nodes(), 1 / (kBend_m * kBend_m))};
  const Eigen::MatrixXd covariance = dense_normal(coarse, fit).inverse();
  for (const auto& [from, to] : {std::array{0, 8}, std::array{8, 11}, std::array{11, 16}}) {
    double drawn = 0, expected = 0;
    for (int r = 0; r < coarse.rows; ++r) {
      for (int c = from; c < to; ++c) {
        const std::size_t i = coarse.index(c, r);
        expected += covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
        for (int draw = 0; draw < errors.draws; ++draw) {
          const double error = errors.heights_m[draw * coarse.nodes() + i];
          drawn += error * error / errors.draws;
        }
      }
    }
    EXPECT_NEAR(std::sqrt(drawn / expected), 1, 0.2) << "columns " << from << " to " << to;
  }
}

TEST(SpreadOf, GrowsAwayFromWhatIsSeen) {
  const ErrorDraws errors = draw_errors(kFine, parabola(), seen_in_the_west(500), kNoise_m);
  const Field spread_m = spread_of(kFine, errors);
  for (int row = 0; row < kFine.rows; ++row) {
    EXPECT_LT(spread_m[kFine.index(8, row)], 0.03);
    EXPECT_LT(spread_m[kFine.index(8, row)], spread_m[kFine.index(22, row)]);
    EXPECT_LT(spread_m[kFine.index(22, row)], spread_m[kFine.index(31, row)]);
  }
}

// Without draws' own spread the doubt is left, and even bare ground leaves 0.03 of the noise.
TEST(SpreadOf, IsNoLessThanTheDoubt) {
  Evidence evidence = seen_in_the_west(1e9f);
  std::ranges::fill(evidence.data, 1e9f);
  const auto spread_m = [&] {
    return spread_of(kFine, draw_errors(kFine, parabola(), evidence, kNoise_m))[kFine.index(9, 9)];
  };
  EXPECT_NEAR(spread_m(), 0.03 * kNoise_m, 1e-4);
  std::ranges::fill(evidence.doubt_m, 0.01f);
  EXPECT_NEAR(spread_m(), 0.01, 1e-4);
}

}  // namespace
}  // namespace plotscan::ground
