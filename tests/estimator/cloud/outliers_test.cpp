// SPDX-License-Identifier: Apache-2.0
#include "cloud/internal/outliers.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "tiled_clouds.h"

namespace plotscan::cloud {
namespace {

std::size_t dropped(const Points& points) {
  TiledPoints cloud = tiled(points);
  return drop_outliers(cloud, 2);
}

// What is there stays: nothing else would do on any of these.
TEST(Outliers, AreNotInReliefSlopesAndTallCrops) {
  const Height steep = [](double x, double) { return 0.2 * x; };
  const Height rough = [](double x, double y) { return std::sin(1.1 * x) * std::cos(1.3 * y); };
  const Height bank = [](double x, double) { return x < 10 ? 0.0 : 2.5; };
  const Height maize = [](double x, double y) {
    const bool crop = x > 8 && y > 8;
    return crop ? 3 * std::abs(std::sin(57 * x) * std::sin(91 * y)) : 0;
  };
  for (const Height& height : {steep, rough, bank, maize}) {
    for (const double density : {3.0, 30.0, 300.0})
      EXPECT_EQ(dropped(scanned(density, 20, height)), 0u);
  }
  EXPECT_EQ(dropped(scanned(20, 200, steep)), 0u);
}

// Of a closed canopy 3 m high, one point in 300 comes from the ground below.
TEST(Outliers, AreNotTheFewReturnsUnderAClosedCanopy) {
  for (const double density : {20.0, 150.0, 1000.0}) {
    Points points = scanned(density, 24, [](double, double) { return 3.0; });
    const Points ground = scanned(
        density / 300, 24, [](double, double) { return 0.0; }, 1);
    points.insert(points.end(), ground.begin(), ground.end());
    // Around it, an alley from which the ground is seen.
    const Points alley = scanned(
        density, 30, [](double, double) { return 0.0; }, 2);
    for (const Eigen::Vector3f& p : alley)
      if (p.x() > 24 || p.y() > 24) points.push_back(p);
    EXPECT_EQ(dropped(points), 0u) << density;
  }
}

TEST(Outliers, FarAboveAndBelowAreDropped) {
  const Height slope = [](double x, double) { return 0.2 * x; };
  for (const double density : {3.0, 300.0}) {
    Points points = scanned(density, 30, slope);
    const std::size_t real = points.size();
    for (const float z : {-40.0f, -11.0f, 18.0f, 300.0f, 1e6f}) points.emplace_back(15.2f, 7.7f, z);
    TiledPoints cloud = tiled(points);
    EXPECT_EQ(drop_outliers(cloud, 1), 5u);
    ASSERT_EQ(cloud.points.size(), real);
    EXPECT_EQ(cloud.begin.back(), real);
    for (std::size_t tile = 0; tile < cloud.tiles.size(); ++tile)
      for (std::size_t i = cloud.begin[tile]; i < cloud.begin[tile + 1]; ++i)
        ASSERT_EQ(std::floor(cloud.points[i].x()), cloud.tiles[tile].x);
  }
}

TEST(Outliers, LonelyPointsBelowAndAboveAreDropped) {
  Points points = scanned(300, 30, [](double x, double) { return 0.05 * x; });
  points.emplace_back(15.2f, 7.7f, -1.8f);  // multipath: 2.5 m below the ground
  points.emplace_back(15.4f, 7.8f, -1.9f);
  points.emplace_back(4.5f, 20.5f, 4.0f);   // a bird
  points.emplace_back(10.5f, 20.5f, 0.3f);  // 0.2 m below the ground: not for us to judge
  EXPECT_EQ(dropped(points), 3u);
}

TEST(Outliers, AreTheSameForAnyNumberOfThreads) {
  Points points = scanned(100, 30, [](double x, double) { return 0.05 * x; });
  const Points stray =
      scanned(0.3, 30, [](double x, double y) { return 25 * std::sin(57 * x + y); });
  points.insert(points.end(), stray.begin(), stray.end());
  TiledPoints one = tiled(points);
  TiledPoints two = one;
  EXPECT_GT(drop_outliers(one, 1), 100u);
  drop_outliers(two, 2);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.begin, two.begin);
}

}  // namespace
}  // namespace plotscan::cloud
