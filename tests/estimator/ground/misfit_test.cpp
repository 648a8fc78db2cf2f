// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/misfit.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "random_fields.h"

namespace plotscan::ground {
namespace {

const Grid kWide{.cell_m = 0.5, .columns = 60, .rows = 60};
constexpr double kSpread_m = 0.1;

// Layers of so many returns each that lie normally distributed about a surface at 0, which they did
// not pull.
Layer normal_layers(float returns) {
  RandomStream random(11, random_purpose("test/misfit"), 0);
  Layer layer{.z_m = Field(kWide.nodes()),
              .weight = Field(kWide.nodes(), 1),
              .returns = Field(kWide.nodes(), returns),
              .scatter = Field(kWide.nodes(), 0)};
  for (float& z : layer.z_m) z = static_cast<float>(kSpread_m * random.normal());
  return layer;
}

Evidence no_evidence() {
  const Field none(kWide.nodes(), 0);
  return {.target_m = none, .data = none, .doubt_m = none, .support = none};
}

double mean_misfit(const Layer& layer, const Evidence& evidence, const Field& sd_m) {
  const Field level(kWide.nodes(), 0);
  const Field here = misfit(kWide, layer, {.z_m = level, .evidence = evidence, .sd_m = sd_m});
  return std::accumulate(here.begin(), here.end(), 0.0) / static_cast<double>(here.size());
}

TEST(Misfit, IsTheSpreadOfLayersWithManyReturns) {
  const Field exact(kWide.nodes(), 0);
  EXPECT_NEAR(mean_misfit(normal_layers(20), no_evidence(), exact), kSpread_m, 0.1 * kSpread_m);
}

// Where returns are few: 1.18 times the squared mean of the distances' square roots. Of a normal
// distribution, that mean is 2^(1/4) Gamma(3/4) / sqrt(pi) of the root of sigma.
TEST(Misfit, TakesTheMeanOfRootsWhereReturnsAreFew) {
  const double root = std::pow(2, 0.25) * std::tgamma(0.75) / std::sqrt(M_PI);
  const double expected_m = 1.18 * root * root * kSpread_m;
  const Field exact(kWide.nodes(), 0);
  EXPECT_NEAR(mean_misfit(normal_layers(2), no_evidence(), exact), expected_m, 0.1 * expected_m);
}

// Layers far above are roofs and woods.
TEST(Misfit, LeavesOutWhatLiesFarAbove) {
  Layer layer = normal_layers(20);
  for (std::size_t i = 0; i < layer.z_m.size(); i += 3) layer.z_m[i] = 4;
  const Field exact(kWide.nodes(), 0);
  EXPECT_NEAR(mean_misfit(layer, no_evidence(), exact), kSpread_m, 0.15 * kSpread_m);
}

// A surface that its data pull by half is half as far from them as one without them.
TEST(Misfit, CountsDataWithoutTheirOwnPull) {
  const Layer layer = normal_layers(20);
  Evidence evidence = no_evidence();
  evidence.target_m = layer.z_m;
  const float precise = 1e6;  // 1 / m^2: the data's own noise is 1 mm
  evidence.data = Field(kWide.nodes(), precise);
  const Field half(kWide.nodes(), std::sqrt(0.5f / precise));
  EXPECT_NEAR(mean_misfit(layer, evidence, half), 2 * kSpread_m, 0.2 * kSpread_m);
}

// The noise of a column's mean is no error of the surface.
TEST(Misfit, IsNothingWhereOnlyNoiseIsSeen) {
  const Layer layer = normal_layers(20);
  Evidence evidence = no_evidence();
  evidence.target_m = layer.z_m;
  evidence.data = Field(kWide.nodes(), static_cast<float>(1 / (kSpread_m * kSpread_m)));
  const Field exact(kWide.nodes(), 0);
  EXPECT_LT(mean_misfit(layer, evidence, exact), 0.35 * kSpread_m);
}

}  // namespace
}  // namespace plotscan::ground
