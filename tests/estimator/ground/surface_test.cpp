// SPDX-License-Identifier: Apache-2.0
#include "ground/surface.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"

namespace plotscan::ground {
namespace {

using Terrain = std::function<double(double, double)>;

// Returns of bare ground, uniform over a square about the origin.
std::vector<Eigen::Vector3f> bare_field(const Terrain& terrain, double side_m, int per_m2,
                                        double noise_m) {
  RandomStream random(5, random_purpose("test/ground"), 0);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < per_m2 * side_m * side_m; ++i) {
    const double x = random.uniform(-0.5 * side_m, 0.5 * side_m);
    const double y = random.uniform(-0.5 * side_m, 0.5 * side_m);
    points.push_back(
        Eigen::Vector3d(x, y, terrain(x, y) + noise_m * random.normal()).cast<float>());
  }
  return points;
}

TEST(FitSurface, FindsAPlaneAndItsNoise) {
  const Terrain plane = [](double x, double y) { return 5 + 0.15 * x - 0.08 * y; };
  const Surface surface = fit_surface(bare_field(plane, 12, 400, 0.03), SurfaceOptions());
  EXPECT_NEAR(surface.noise_m, 0.03, 0.003);
  for (double x = -5; x <= 5; x += 0.5) {
    for (double y = -5; y <= 5; y += 0.5) {
      EXPECT_NEAR(surface.height({x, y}), plane(x, y), 0.01);
      EXPECT_NEAR(surface.slope({x, y}).x(), 0.15, 0.05);
    }
  }
}

TEST(FitSurface, RefusesACellOutOfRangeAndACloudWithoutPoints) {
  EXPECT_THROW(fit_surface({}, SurfaceOptions()), InputError);
  const std::vector<Eigen::Vector3f> points(100, Eigen::Vector3f::Zero());
  SurfaceOptions options;
  options.cell_m = 0;
  EXPECT_THROW(fit_surface(points, options), InputError);
}

}  // namespace
}  // namespace plotscan::ground
