// SPDX-License-Identifier: Apache-2.0
#include "view/internal/camera.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::view {
namespace {

std::vector<Eigen::Vector3d> some_points(std::uint64_t seed, const Eigen::Vector3d& spread) {
  std::vector<Eigen::Vector3d> points;
  for (std::uint64_t i = 0; i < 40; ++i) {
    RandomStream random(seed, random_purpose("test/seen"), i);
    points.emplace_back(100 + spread.x() * random.uniform(-1, 1),
                        -50 + spread.y() * random.uniform(-1, 1), spread.z() * random.uniform());
  }
  return points;
}

Eigen::AlignedBox2d seen(const Camera& camera, const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& point : points) box.extend(camera.project(point));
  return box;
}

// 2 % of air: what is seen reaches to 1 / 1.02 of the picture on both sides.
constexpr double kEdge = 1 / 1.02;

TEST(Camera, SeesAllAndNoMoreThanTheWidthAsks) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const double elevation_deg : {20.0, 35.0, 80.0}) {
      const auto points = some_points(seed, {20, 8, 1});
      const Camera camera = camera_that_sees(points, {-60, elevation_deg}, 1);
      const Eigen::AlignedBox2d box = seen(camera, points);
      EXPECT_NEAR(box.min().x(), -kEdge, 1e-9);
      EXPECT_NEAR(box.max().x(), kEdge, 1e-9);
      EXPECT_NEAR(box.min().y(), -kEdge, 1e-6) << "the picture is as low as they allow";
      EXPECT_NEAR(box.max().y(), kEdge, 1e-6);
      EXPECT_LT(camera.up_slope, camera.right_slope);
    }
  }
}

TEST(Camera, KeepsTheHeightWhereThePointsAreHigh) {
  const auto points = some_points(4, {2, 2, 30});
  const Camera camera = camera_that_sees(points, {30, 10}, 2);
  const Eigen::AlignedBox2d box = seen(camera, points);
  EXPECT_NEAR(camera.up_slope * 2, camera.right_slope, 1e-9);
  EXPECT_NEAR(box.min().y(), -kEdge, 1e-6);
  EXPECT_NEAR(box.max().y(), kEdge, 1e-6);
  EXPECT_GT(box.min().x(), -kEdge);
  EXPECT_LT(box.max().x(), kEdge);
}

}  // namespace
}  // namespace plotscan::view
