// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/mixture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "random_fields.h"

namespace plotscan::ground {
namespace {

constexpr double kSigma_m = 0.02;
constexpr int kReturns = 200;  // a column

const Grid kGrid{.cell_m = 0.2, .columns = 12, .rows = 12};

// Of the nodes whose pooled shares do not reach the border.
template <class Value>
double mean_inside(const Value& value) {
  double sum = 0;
  int count = 0;
  for (int row = 2; row < kGrid.rows - 2; ++row) {
    for (int column = 2; column < kGrid.columns - 2; ++column, ++count)
      sum += value(kGrid.index(column, row));
  }
  return sum / count;
}

double rms_target_m(const Evidence& evidence) {
  return std::sqrt(
      mean_inside([&](std::size_t i) { return evidence.target_m[i] * evidence.target_m[i]; }));
}

// Half leaves above 0.4 m, half ground at 0.
double seen_ground(RandomStream& random) {
  return random.uniform() < 0.5 ? kSigma_m * random.normal() : random.uniform(0.4, 0.9);
}

// n returns of ground determine its height to sigma / sqrt(n).
TEST(Weigh, HasThePrecisionOfTheGroundsReturns) {
  const Columns columns = columns_with(kGrid, kReturns, 2, seen_ground);
  const Evidence evidence = weigh(columns, Field(kGrid.nodes(), 0), kSigma_m);
  const double expected = 0.5 * kReturns / (kSigma_m * kSigma_m);
  EXPECT_NEAR(mean_inside([&](std::size_t i) { return evidence.data[i]; }), expected,
              0.1 * expected);
  EXPECT_NEAR(rms_target_m(evidence), kSigma_m / std::sqrt(0.5 * kReturns), 0.0004);
  EXPECT_NEAR(mean_inside([&](std::size_t i) { return evidence.support[i]; }), 1, 0.01);
}

// From a surface that lies off by one sigma below or two above, steps lead to the ground.
TEST(Weigh, LeadsBackToTheGround) {
  const Columns columns = columns_with(kGrid, kReturns, 3, seen_ground);
  for (const double off_sigmas : {-1.0, -0.5, 1.0, 2.0}) {
    Field surface(kGrid.nodes(), static_cast<float>(off_sigmas * kSigma_m));
    for (int step = 0; step < 6; ++step) surface = weigh(columns, surface, kSigma_m).target_m;
    EXPECT_NEAR(mean_inside([&](std::size_t i) { return surface[i]; }), 0, 0.001) << off_sigmas;
  }
}

// A canopy without a peak at its underside is no ground.
TEST(Weigh, GivesNoWeightToACanopyAlone) {
  const Columns columns = columns_with(
      kGrid, kReturns, 4, [](RandomStream& random) { return random.uniform(-0.3, 0.7); });
  const Evidence evidence = weigh(columns, Field(kGrid.nodes(), 0), kSigma_m);
  EXPECT_LT(mean_inside([&](std::size_t i) { return evidence.support[i]; }), 0.02);
}

// Leaves down to the ground, of as many returns a sigma as the ground has in all: its peak stands
// out less, so the doubt is larger.
TEST(Weigh, DoubtsTheGroundOfACanopyThatReachesIt) {
  const auto doubt_m = [](double highest_leaf_m) {
    const Columns columns = columns_with(kGrid, kReturns, 5, [&](RandomStream& random) {
      return random.uniform() < 0.5 ? kSigma_m * random.normal()
                                    : random.uniform(0, highest_leaf_m);
    });
    const Evidence evidence = weigh(columns, Field(kGrid.nodes(), 0), kSigma_m);
    return mean_inside([&](std::size_t i) { return evidence.doubt_m[i]; });
  };
  const double sparse_m = doubt_m(1.6), dense_m = doubt_m(0.2);
  // A peak of 0.4 n / sigma on leaves of n a height of h: the contrast is 0.4 h / sigma.
  EXPECT_NEAR(sparse_m, 0.3 * kSigma_m / (0.4 * 1.6 / kSigma_m), 0.3 * sparse_m);
  EXPECT_NEAR(dense_m, 0.3 * kSigma_m / (0.4 * 0.2 / kSigma_m), 0.3 * dense_m);
}

// A column without ground returns under a surface that those around support: it cuts something off.
TEST(Weigh, GivesNoSupportToAColumnThatDisagreesWithThoseAround) {
  Columns columns = columns_with(kGrid, kReturns, 6,
                                 [](RandomStream& random) { return kSigma_m * random.normal(); });
  const std::size_t ridge = kGrid.index(6, 6);
  for (std::uint32_t k = columns.first[ridge]; k < columns.first[ridge + 1]; ++k)
    columns.returns[k].z_m += 0.5f;
  const Evidence evidence = weigh(columns, Field(kGrid.nodes(), 0), kSigma_m);
  EXPECT_EQ(evidence.support[ridge], 0);
  EXPECT_EQ(evidence.data[ridge], 0);
  EXPECT_GT(evidence.support[kGrid.index(7, 6)], 0.9);
}

}  // namespace
}  // namespace plotscan::ground
