// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "estimator/plots/known_trial.h"
#include "plots/signs/internal/plot_shape.h"

namespace plotscan::plots {
namespace {

// So many returns in every plot, at a height that a normal number of sd sigma_m moves off a slope.
std::vector<Eigen::Vector3f> tops_over(const TrialLayout& trial, double slope, double sigma_m,
                                       std::uint64_t returns = 400) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < returns * trial.places.size(); ++i) {
    RandomStream random(8, random_purpose("test/roughness"), i);
    const Eigen::Vector2d center = trial.box(trial.places[i % trial.places.size()]).center;
    const Eigen::Vector2d off(random.uniform(-1.4, 1.4), random.uniform(-0.7, 0.7));
    const double z_m = 1 + slope * off.x() + sigma_m * random.normal();
    points.emplace_back(static_cast<float>(center.x() + off.x()),
                        static_cast<float>(center.y() + off.y()), static_cast<float>(z_m));
  }
  return points;
}

// Over the height, which is the 95th percentile: 1.645 sigmas above the mean.
TEST(Roughness, IsTheScatterAboutAPlaneOverTheHeight) {
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_of(trial);
  const auto points = tops_over(trial, 0, 0.1);
  const double height_m = 1 + 1.645 * 0.1;
  EXPECT_NEAR(roughness(lattice_of(trial, raster), points, 0).of_height, 0.1 / height_m, 0.004);
  // Of which a part is the sensor's.
  EXPECT_NEAR(roughness(lattice_of(trial, raster), points, 0.06).of_height, 0.08 / height_m, 0.004);
}

TEST(Roughness, OfASlopeIsNone) {
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_of(trial);
  EXPECT_LT(roughness(lattice_of(trial, raster), tops_over(trial, 0.2, 0), 0).of_height, 1e-4);
}

// The rows may follow each other along either axis of the raster.
TEST(Roughness, IsTheSameOfALatticeTurned) {
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_of(trial);
  const Lattice lattice = lattice_of(trial, raster);
  const auto points = tops_over(trial, 0, 0.1);
  EXPECT_EQ(roughness(lattice, points, 0).of_height,
            roughness(lattice.turned(), points, 0).of_height);
}

TEST(Roughness, IsNotKnownOfFewReturns) {
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_of(trial);
  EXPECT_TRUE(std::isnan(roughness(lattice_of(trial, raster), {}, 0).of_height));
}

// A car's roof and bonnet: the plot is rough, but nothing more than noise is in its patches.
TEST(PatchScatter, OfASteppedSurfaceIsThatOfTheNoise) {
  constexpr double kOfSensor_m = 0.01;
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_of(trial);
  std::vector<Eigen::Vector3f> points = tops_over(trial, 0, kOfSensor_m, 2000);
  for (Eigen::Vector3f& point : points) point.z() += std::fmod(point.x(), 1.6F) < 0.8F ? 0.5F : 0;
  const Roughness tops = roughness(lattice_of(trial, raster), points, kOfSensor_m);
  EXPECT_GT(tops.of_height, 0.1);
  EXPECT_NEAR(tops.in_patches, 1, 0.15);
}

TEST(PatchScatter, OfACanopyIsThatOfItsLeaves) {
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_of(trial);
  const auto points = tops_over(trial, 0, 0.02, 2000);
  EXPECT_NEAR(roughness(lattice_of(trial, raster), points, 0.005).in_patches, 4, 0.4);
}

TEST(PatchScatter, IsNotKnownWhereNoiseMayHideLeaves) {
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_of(trial);
  const auto points = tops_over(trial, 0, 0.05, 2000);
  EXPECT_TRUE(std::isnan(roughness(lattice_of(trial, raster), points, 0.012).in_patches));
  EXPECT_FALSE(std::isnan(roughness(lattice_of(trial, raster), points, 0.010).in_patches));
}

}  // namespace
}  // namespace plotscan::plots
