// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/internal/oriented_box.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/random.h"

namespace plotscan::methods::dhami2020 {
namespace {

std::vector<Eigen::Vector2d> random_points(std::uint64_t seed, int count) {
  RandomStream random(seed, random_purpose("test/hull"), 0);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(3 * random.normal() + 10, random.normal() - 20);
  return points;
}

// The least area over a fine scan of angles: an upper bound of the optimum, close to it.
double scanned_area(const std::vector<Eigen::Vector2d>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 20000; ++step) {
    const double angle = kPi / 2 * step / 20000;
    Eigen::Array2d low = Eigen::Array2d::Constant(1e300);
    Eigen::Array2d high = -low;
    for (const auto& point : points) {
      const Eigen::Array2d local(std::cos(angle) * point.x() + std::sin(angle) * point.y(),
                                 -std::sin(angle) * point.x() + std::cos(angle) * point.y());
      low = low.min(local);
      high = high.max(local);
    }
    least = std::min(least, (high - low).prod());
  }
  return least;
}

TEST(MinimumAreaBox, AgreesWithAScanOfAngles) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto points = random_points(seed, 60);
    const PlotBox box = minimum_area_box(points);
    const double scanned = scanned_area(points);
    EXPECT_LE(box.area_m2(), scanned + 1e-9) << "seed " << seed;
    EXPECT_GE(box.area_m2(), scanned * 0.999) << "seed " << seed;
  }
}

TEST(MinimumAreaBox, HoldsEveryPoint) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto points = random_points(seed, 200);
    PlotBox box = minimum_area_box(points);
    EXPECT_GE(box.length_m, box.width_m);
    box.length_m += 1e-9;
    box.width_m += 1e-9;
    for (const auto& point : points) EXPECT_TRUE(box.contains(point));
  }
}

TEST(MinimumAreaBox, RecoversARectangleAtAnyHeading) {
  for (const double degrees : {0.0, 17.0, 45.0, 90.0, 133.0, 179.0}) {
    const PlotBox truth{.center = {500000.0, 5000000.0},
                        .width_m = 1.5,
                        .length_m = 4,
                        .heading_rad = radians(degrees)};
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i <= 20; ++i) {
      for (int j = 0; j <= 10; ++j) {
        points.emplace_back(truth.center + truth.length_axis() * 4 * (i / 20.0 - 0.5) +
                            truth.width_axis() * 1.5 * (j / 10.0 - 0.5));
      }
    }
    const PlotBox box = minimum_area_box(points);
    EXPECT_NEAR(box.width_m, 1.5, 1e-6);
    EXPECT_NEAR(box.length_m, 4, 1e-6);
    EXPECT_LT(heading_difference(box.heading_rad, truth.heading_rad), 1e-6) << degrees;
    EXPECT_LT((box.center - truth.center).norm(), 1e-6);
  }
}

TEST(MinimumAreaBox, StandsDegenerateClusters) {
  EXPECT_EQ(minimum_area_box({{3, 4}, {3, 4}}).area_m2(), 0);
  const PlotBox segment = minimum_area_box({{0, 0}, {3, 4}});
  EXPECT_NEAR(segment.length_m, 5, 1e-12);
  EXPECT_NEAR(segment.width_m, 0, 1e-12);
}

}  // namespace
}  // namespace plotscan::methods::dhami2020
