// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/internal/upside_down.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::methods::lattice {
namespace {

constexpr double kScatter_m = 0.015;

// 400 returns a square metre of plots 1.5 m x 4 m between alleys of 0.6 m, on a slope; the canopy
// lets a share of the returns through and is `tall_m` high.
std::vector<Eigen::Vector3f> field(double through, double tall_m) {
  RandomStream random(9, random_purpose("test/upside_down"), 0);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 57'600; ++i) {
    const double x = random.uniform(0, 12), y = random.uniform(0, 12);
    const bool in_plot = std::fmod(x, 2.1) < 1.5 && std::fmod(y, 4.6) < 4;
    double z = 20 + 0.1 * x + kScatter_m * random.normal();
    if (in_plot && random.uniform() >= through) z += tall_m * std::sqrt(random.uniform());
    points.emplace_back(Eigen::Vector3d(x, y, z).cast<float>());
  }
  return points;
}

std::vector<Eigen::Vector3f> turned(std::vector<Eigen::Vector3f> points) {
  for (Eigen::Vector3f& point : points) point.z() = -point.z();
  return points;
}

TEST(IsUpsideDown, TellsAFieldFromTheSameWithZDown) {
  for (const double through : {0.02, 0.3, 0.6}) {
    for (const double tall_m : {0.5, 2.0}) {
      const std::vector<Eigen::Vector3f> points = field(through, tall_m);
      EXPECT_FALSE(is_upside_down(points, kScatter_m)) << through << " " << tall_m;
      EXPECT_TRUE(is_upside_down(turned(points), kScatter_m)) << through << " " << tall_m;
    }
  }
}

TEST(IsUpsideDown, IsNotSaidOfBareGround) {
  const std::vector<Eigen::Vector3f> bare = field(1, 0.5);
  EXPECT_FALSE(is_upside_down(bare, kScatter_m));
  EXPECT_FALSE(is_upside_down(turned(bare), kScatter_m));
}

}  // namespace
}  // namespace plotscan::methods::lattice
