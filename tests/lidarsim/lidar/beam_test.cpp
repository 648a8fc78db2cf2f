// SPDX-License-Identifier: Apache-2.0
// The sub-rays' footprint against the closed forms of the Gaussian.
#include "lidar/internal/beam.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "sub_rays.h"

namespace plotscan::lidar {
namespace {

constexpr sensor::Beam kBeam = {.along_rad = 3e-3, .across_rad = 1.5e-3};

TEST(Beam, PatternHasTheMomentsOfTheNormalDistribution) {
  for (int count = 2; count <= kMaxSubRays; ++count) {
    const auto points = normal_pattern(count);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
    Eigen::Vector2d sum(0, 0);
    Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
    for (const Eigen::Vector2d& point : points) {
      sum += point;
      squares += point * point.transpose() / count;
    }
    ASSERT_EQ(sum, Eigen::Vector2d::Zero()) << count;
    ASSERT_NEAR(squares.trace(), 2, 1e-12) << count;
    if (count > 3) {
      ASSERT_LT((squares - Eigen::Matrix2d::Identity()).norm(), 1e-12) << count;
    }
  }
}

// The normal distribution has E[r^4] = 8; that of few points falls short of it.
TEST(Beam, PatternsFourthMomentTendsToTheNormalDistributions) {
  for (const int count : {4, 7, 16, 37, 100, 333, 1024}) {
    double fourth = 0;
    for (const Eigen::Vector2d& point : normal_pattern(count))
      fourth += std::pow(point.squaredNorm(), 2) / count;
    EXPECT_NEAR(fourth, 8, 14 * std::pow(count, -0.85)) << count;
  }
}

// Within k times the 1/e^2 ellipse lies 1 - exp(-2 k^2) of a Gaussian beam's energy.
TEST(Beam, EllipsesHoldTheirShareOfTheEnergy) {
  const Ray axis{{1, 2, 3}, Eigen::Vector3f(0.2f, 0.3f, -1).normalized()};
  const Eigen::Vector3f spin_axis = Eigen::Vector3f::UnitX();
  const Eigen::Vector3d along = axis.direction.cross(spin_axis).normalized().cast<double>();
  const Eigen::Vector3d across = axis.direction.cast<double>().cross(along);
  for (const int count : {5, 7, 19, 64, 200, 1024}) {
    const std::vector<Ray> rays =
        testing::sub_rays_of(SubRays(kBeam, count), axis, spin_axis, 12345);
    for (const double k : {0.4, 0.6, 0.8, 1.0, 1.3}) {
      int inside = 0;
      for (const Ray& ray : rays) {
        const Eigen::Vector3d direction = ray.direction.cast<double>();
        const double x = direction.dot(along) / (kBeam.along_rad / 2);
        const double y = direction.dot(across) / (kBeam.across_rad / 2);
        inside += x * x + y * y <= k * k ? 1 : 0;
      }
      EXPECT_NEAR(static_cast<double>(inside) / count, 1 - std::exp(-2 * k * k), 3.0 / count)
          << count << " sub-rays, k " << k;
    }
  }
}

// Spread along the spin and across it, whatever way the axis and the lidar look.
TEST(Beam, LiesWithTheScan) {
  const Eigen::Vector3f spin_axis = Eigen::Vector3f(0.3f, -0.8f, 0.1f).normalized();
  for (const Eigen::Vector3f& toward :
       {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0.1f, 0.2f, -1), Eigen::Vector3f(-2, 1, 0.5f)}) {
    const Ray axis{{0, 0, 8}, toward.normalized()};
    // The direction in which a turn about the spin axis moves the axis.
    const Eigen::Vector3d spin =
        (Eigen::AngleAxisf(-1e-2f, spin_axis) * axis.direction - axis.direction).cast<double>();
    Eigen::Vector3d along =
        spin - spin.dot(axis.direction.cast<double>()) * axis.direction.cast<double>();
    along.normalize();
    const Eigen::Vector3d across = axis.direction.cast<double>().cross(along);
    for (const int count : {4, 7, 37}) {
      for (const std::uint64_t shot : {0ull, 1ull, 17ull, 123'456'789'012ull}) {
        const std::vector<Ray> rays =
            testing::sub_rays_of(SubRays(kBeam, count), axis, spin_axis, shot);
        ASSERT_EQ(rays.size(), static_cast<std::size_t>(count));
        Eigen::Vector3d mean(0, 0, 0);
        double along_square = 0;
        double across_square = 0;
        for (const Ray& ray : rays) {
          ASSERT_EQ(ray.origin_m, axis.origin_m);
          ASSERT_NEAR(ray.direction.norm(), 1, 1e-6);
          mean += ray.direction.cast<double>() / count;
          along_square += std::pow(ray.direction.cast<double>().dot(along), 2) / count;
          across_square += std::pow(ray.direction.cast<double>().dot(across), 2) / count;
        }
        EXPECT_NEAR(mean.cross(axis.direction.cast<double>()).norm(), 0, 2e-7);
        // Standard deviations are a quarter of the full angles.
        EXPECT_NEAR(std::sqrt(along_square), 0.75e-3, 5e-6) << count << " of shot " << shot;
        EXPECT_NEAR(std::sqrt(across_square), 0.375e-3, 5e-6) << count << " of shot " << shot;
      }
    }
  }
}

TEST(Beam, ShotAlongTheSpinAxisKeepsItsSpread) {
  const std::vector<Ray> rays =
      testing::sub_rays_of(SubRays(kBeam, 16), {{0, 0, 0}, {0, 0, 1}}, {0, 0, 1}, 3);
  double square = 0;
  for (const Ray& ray : rays) square += ray.direction.head<2>().squaredNorm() / 16;
  EXPECT_NEAR(std::sqrt(square), std::hypot(0.75e-3, 0.375e-3), 1e-6);
}

TEST(Beam, OneSubRayIsTheAxis) {
  const Ray axis{{1, 2, 3}, Eigen::Vector3f(1, 2, -7).normalized()};
  const std::vector<Ray> rays = testing::sub_rays_of(SubRays(kBeam, 1), axis, {0, 0, 1}, 5);
  ASSERT_EQ(rays.size(), 1u);
  EXPECT_NEAR((rays[0].direction - axis.direction).norm(), 0, 1e-7);
}

}  // namespace
}  // namespace plotscan::lidar
