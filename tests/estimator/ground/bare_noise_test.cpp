// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/bare_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "random_fields.h"

namespace plotscan::ground {
namespace {

const Grid kBare{.cell_m = 0.2, .columns = 60, .rows = 60};
constexpr double kSensor_m = 0.02;

double sensor_noise(RandomStream& random) { return kSensor_m * random.normal(); }

TEST(BareNoise, IsThatOfBareGround) {
  for (const int returns : {4, 20, 60})
    EXPECT_NEAR(bare_noise_m(block_spreads(columns_with(kBare, returns, 1, sensor_noise))),
                kSensor_m, 0.1 * kSensor_m)
        << returns;
}

// The spread is taken about each block's own plane.
TEST(BareNoise, IsTheSameOnASlope) {
  Columns columns = columns_with(kBare, 30, 2, sensor_noise);
  for (int row = 0; row < kBare.rows; ++row) {
    for (int column = 0; column < kBare.columns; ++column) {
      const std::size_t node = kBare.index(column, row);
      for (std::uint32_t k = columns.first[node]; k < columns.first[node + 1]; ++k) {
        Return& here = columns.returns[k];
        here.z_m += 0.1f * (static_cast<float>(column) + here.east()) -
                    0.06f * (static_cast<float>(row) + here.north());
      }
    }
  }
  EXPECT_NEAR(bare_noise_m(block_spreads(columns)), kSensor_m, 0.1 * kSensor_m);
}

// Three columns of ten are bare; canopies scatter by decimetres.
TEST(BareNoise, IsSeenBetweenPlots) {
  Columns columns = columns_with(kBare, 30, 3, sensor_noise);
  RandomStream random(3, random_purpose("test/leaves"), 0);
  for (std::size_t node = 0; node < kBare.nodes(); ++node) {
    if (node % kBare.columns % 10 < 3) continue;
    for (std::uint32_t k = columns.first[node]; k < columns.first[node + 1]; ++k)
      columns.returns[k].z_m += static_cast<float>(random.uniform(0, 0.6));
  }
  EXPECT_NEAR(bare_noise_m(block_spreads(columns)), kSensor_m, 0.25 * kSensor_m);
}

TEST(BareNoise, IsUsualWhereTooLittleIsKnown) {
  EXPECT_EQ(bare_noise_m({}), 0.03);
  const BlockSpread exact{.node = 0, .width_m = 0.2, .sigma_m = 0, .range_m = 0};
  EXPECT_EQ(bare_noise_m(std::vector<BlockSpread>(100, exact)), kLeastNoise_m);
}

// Two layers that are d apart scatter by d / 2 more, in quadrature.
TEST(NoiseExcess, IsHalfOfWhatTwoLayersAreApart) {
  constexpr float kApart_m = 0.08f;
  Columns columns = columns_with(kBare, 60, 4, sensor_noise);
  RandomStream random(4, random_purpose("test/strips"), 0);
  const auto overlaps = [](std::size_t node) { return node % kBare.columns < 20; };
  for (std::size_t node = 0; node < kBare.nodes(); ++node) {
    for (std::uint32_t k = columns.first[node]; k < columns.first[node + 1]; ++k)
      if (overlaps(node) && random.uniform() < 0.5) columns.returns[k].z_m += kApart_m;
  }
  const std::vector<BlockSpread> blocks = block_spreads(columns);
  const Field excess_m = noise_excess_m(kBare, blocks, bare_noise_m(blocks));
  for (int row = 0; row < kBare.rows; ++row) {
    EXPECT_NEAR(excess_m[kBare.index(5, row)], 0.5 * kApart_m, 0.05 * kApart_m);
    EXPECT_EQ(excess_m[kBare.index(50, row)], 0);
  }
}

}  // namespace
}  // namespace plotscan::ground
