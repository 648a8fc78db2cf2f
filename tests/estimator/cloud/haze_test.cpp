// SPDX-License-Identifier: Apache-2.0
#include "cloud/internal/haze.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "tiled_clouds.h"

namespace plotscan::cloud {
namespace {

constexpr double kSide_m = 30;

// Plots of 1.5 x 4 m, up to 0.8 m high, with gaps of 1 m, on a slope; every fifth return is from
// the ground. Every tenth of a metre in x and y has one height.
double plots(double x, double y) {
  const bool crop = std::fmod(x, 2.5) < 1.5 && std::fmod(y, 5.0) < 4;
  const double leaf = 0.5 + 0.5 * std::sin(57 * x) * std::sin(91 * y);
  return 0.05 * x + (crop && leaf > 0.2 ? 0.4 + 0.4 * leaf : 0);
}

// One stray return for 100 others, 5 m below to 9.5 m above.
Points haze(double density, std::uint64_t seed) {
  RandomStream random(seed, random_purpose("test/haze"), 0);
  Points points;
  for (double i = 0; i < density / 100 * kSide_m * kSide_m; ++i) {
    points.emplace_back(static_cast<float>(random.uniform(0, kSide_m)),
                        static_cast<float>(random.uniform(0, kSide_m)),
                        static_cast<float>(random.uniform(-5, 9.5)));
  }
  return points;
}

std::size_t dropped_as_haze(const Points& points) {
  TiledPoints cloud = tiled(points);
  return drop_haze(cloud, 2);
}

bool stands_out(const Eigen::Vector3f& point) {
  const double height = point.z() - 0.05 * point.x();
  return height > 2.5 || height < -2;
}

TEST(Haze, IsTakenOutAndNothingElse) {
  for (const double density : {30.0, 100.0, 400.0, 2000.0}) {
    const Points field = scanned(density, kSide_m, plots);
    Points points = field;
    const Points stray = haze(density, 1);
    points.insert(points.end(), stray.begin(), stray.end());
    TiledPoints cloud = tiled(points);
    const std::size_t taken = drop_haze(cloud, 2);
    const auto out = static_cast<double>(std::ranges::count_if(stray, stands_out));
    EXPECT_LT(static_cast<double>(std::ranges::count_if(cloud.points, stands_out)), 0.02 * out)
        << density;
    EXPECT_LE(taken, stray.size() + field.size() / 10000) << density;
    EXPECT_EQ(cloud.points.size() + taken, points.size());
    EXPECT_EQ(cloud.begin.back(), cloud.points.size());
  }
}

// A mast of 3 m in a field: nothing is alone above its tip. Nor is anything below a slope.
TEST(Haze, IsNotInFieldsWithoutIt) {
  const Height steep = [](double x, double) { return 0.5 * x; };
  const Height maize = [](double x, double y) {
    return 3 * std::abs(std::sin(57 * x) * std::sin(91 * y));
  };
  const Height mast = [](double x, double y) { return std::hypot(x - 15, y - 15) < 0.05 ? 3 : 0; };
  for (const Height& height : {Height(plots), steep, maize, mast}) {
    for (const double density : {0.7, 10.0, 100.0, 700.0})
      EXPECT_EQ(dropped_as_haze(scanned(density, kSide_m, height)), 0u) << density;
  }
}

// Of a closed canopy 3 m high one point in 300 comes from the ground; 1 in 100 is a stray.
TEST(Haze, LeavesTheGroundUnderAClosedCanopy) {
  for (const double density : {50.0, 300.0}) {
    Points points = scanned(density, kSide_m, [](double, double) { return 3.0; });
    const Points ground = scanned(
        density / 30, kSide_m, [](double, double) { return 0.0; }, 1);
    points.insert(points.end(), ground.begin(), ground.end());
    const auto low = [](const Eigen::Vector3f& p) { return std::abs(p.z()) < 0.15; };
    EXPECT_EQ(dropped_as_haze(points), 0u);
    const Points stray = haze(density, 2);
    points.insert(points.end(), stray.begin(), stray.end());
    TiledPoints cloud = tiled(points);
    EXPECT_GT(drop_haze(cloud, 2), stray.size() / 2);
    EXPECT_GT(static_cast<double>(std::ranges::count_if(cloud.points, low)),
              0.95 * static_cast<double>(ground.size()));
  }
}

// Tiles that hold nothing but strays are gone.
TEST(Haze, LeavesNoEmptyTiles) {
  Points points = scanned(300, kSide_m, [](double, double) { return 0.0; });
  const Points stray = haze(300, 3);
  points.insert(points.end(), stray.begin(), stray.end());
  for (double x = 5.5; x < 25; ++x)
    for (float z = -4; z < 8; z += 0.11F) points.emplace_back(static_cast<float>(x), 31.5F, z);
  TiledPoints one = tiled(points);
  TiledPoints two = one;
  drop_haze(one, 1);
  drop_haze(two, 2);
  EXPECT_EQ(one.points, two.points);
  for (std::size_t tile = 0; tile < one.tiles.size(); ++tile) EXPECT_GT(one.size(tile), 0u);
}

}  // namespace
}  // namespace plotscan::cloud
