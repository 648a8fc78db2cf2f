// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/random.h"
#include "methods/dhami2020/ground_plane.h"
#include "methods/dhami2020/internal/ground_level.h"

namespace plotscan::methods::dhami2020 {
namespace {

constexpr double kSlopeX = 0.2;
constexpr double kSlopeY = -0.1;
constexpr double kOffset_m = 3.0;

double ground_z(double x, double y) { return kOffset_m + kSlopeX * x + kSlopeY * y; }

// A tilted plane under a block of canopy that covers a third of it.
std::vector<Eigen::Vector3d> tilted_plot(double noise_m) {
  RandomStream random(9, random_purpose("test/plot"), 0);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 3000; ++i) {
    const double x = random.uniform(-5, 5);
    const double y = random.uniform(-5, 5);
    const double canopy_m = std::abs(x) < 1.67 ? random.uniform(0.2, 1) : 0;
    points.emplace_back(x, y, ground_z(x, y) + canopy_m + noise_m * random.normal());
  }
  return points;
}

TEST(LeastSquaresPlane, IsExactOnAPlane) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) points.emplace_back(i, j, ground_z(i, j));
  }
  const GroundPlane plane = least_squares_plane(points);
  EXPECT_LT((plane.centroid - Eigen::Vector3d(2, 2, ground_z(2, 2))).norm(), 1e-12);
  const Eigen::Vector3d normal = Eigen::Vector3d(-kSlopeX, -kSlopeY, 1).normalized();
  EXPECT_LT((plane.normal - normal).norm(), 1e-12);
  EXPECT_NEAR(plane.height_of(Eigen::Vector3d(9, 9, ground_z(9, 9)) + 0.7 * normal), 0.7, 1e-12);
  EXPECT_NEAR(plane.height_of(Eigen::Vector3d(9, 9, ground_z(9, 9)) - 0.7 * normal), -0.7, 1e-12);
}

TEST(FindGroundPlane, FindsTiltedGroundUnderACanopy) {
  const auto exact = find_ground_plane(tilted_plot(0), 0.05);
  ASSERT_TRUE(exact);
  EXPECT_NEAR(exact->height_of({1, 1, ground_z(1, 1)}), 0, 1e-5);
  EXPECT_GE(exact->inliers, 1900u);
  const auto noisy = find_ground_plane(tilted_plot(0.02), 0.05);
  ASSERT_TRUE(noisy);
  EXPECT_NEAR(noisy->height_of({1, 1, ground_z(1, 1)}), 0, 0.005);
}

TEST(FindGroundPlane, KeepsItsPrecisionFarFromTheOrigin) {
  std::vector<Eigen::Vector3d> points = tilted_plot(0);
  const Eigen::Vector3d far(500000, 5000000, 700);
  for (auto& point : points) point += far;
  const auto plane = find_ground_plane(points, 0.05);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->height_of(far + Eigen::Vector3d(1, 1, ground_z(1, 1))), 0, 1e-4);
}

TEST(FindGroundPlane, HasNoneThroughTooFewPoints) {
  EXPECT_FALSE(find_ground_plane({}, 0.05));
  EXPECT_FALSE(find_ground_plane(std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}}, 0.05));
  EXPECT_FALSE(find_ground_plane(std::vector<Eigen::Vector3d>(50, {1, 2, 3}), 0.05));
}

TEST(FitGroundLevel, LiesOnTheGroundUnderACanopy) {
  std::vector<Eigen::Vector3f> points;
  for (double x = -20; x < 20; x += 0.1) {
    for (double y = -20; y < 20; y += 0.1) {
      const bool canopy = static_cast<int>(std::floor(x / 2)) % 3 == 0;  // a third is closed
      points.emplace_back(static_cast<float>(x), static_cast<float>(y),
                          static_cast<float>(ground_z(x, y) + (canopy ? 0.8 : 0)));
    }
  }
  const GroundLevel level = fit_ground_level(points);
  EXPECT_NEAR(level.slope.x(), kSlopeX, 2e-3);
  EXPECT_NEAR(level.slope.y(), kSlopeY, 2e-3);
  for (const double x : {-15.0, 0.0, 15.0}) {
    const Eigen::Vector3d ground(x, 2, ground_z(x, 2));
    EXPECT_NEAR(level.height_of(ground.cast<float>()), 0, 0.01);
  }
}

TEST(FitGroundLevel, IsNotDrawnBelowTheGroundByNoise) {
  RandomStream random(4, random_purpose("test/noise"), 0);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 100000; ++i) {
    points.emplace_back(static_cast<float>(random.uniform(-10, 10)),
                        static_cast<float>(random.uniform(-10, 10)),
                        static_cast<float>(2 + 0.03 * random.normal()));
  }
  EXPECT_NEAR(fit_ground_level(points).offset_m, 2, 0.002);
}

TEST(FitGroundLevel, StandsASinglePoint) {
  const GroundLevel level = fit_ground_level(std::vector<Eigen::Vector3f>{{0, 0, 5}});
  EXPECT_NEAR(level.height_of({0, 0, 5}), 0, 1e-6);
}

}  // namespace
}  // namespace plotscan::methods::dhami2020
