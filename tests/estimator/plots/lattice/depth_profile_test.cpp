// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/depth_profile.h"

#include <gtest/gtest.h>

#include "estimator/plots/known_trial.h"

namespace plotscan::plots {
namespace {

TEST(BlurredBox, IsTheDifferenceOfTwoNormalDistributions) {
  const BlurredBox box(1.5, 0.1);
  for (double x_m = -1.3; x_m <= 1.3; x_m += 0.013)
    EXPECT_NEAR(box(x_m), blurred_box(x_m, 1.5, 0.1), 1e-4) << x_m;
  EXPECT_NEAR(box(0.75), 0.5, 1e-4);
}

// Depths of a box of size_m; where a plot lies within its cells is known to half a cell.
void expect_depths_of_box(const DepthProfile& profile, double depth, double size_m) {
  for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
    const double x_m = profile.x_m[i];
    const double one = depth * blurred_box(x_m - 0.025, size_m, 0.08);
    const double other = depth * blurred_box(x_m + 0.025, size_m, 0.08);
    EXPECT_GT(profile.depth[i], std::min(one, other) - 0.05) << x_m;
    EXPECT_LT(profile.depth[i], std::max(one, other) + 0.05) << x_m;
  }
}

TEST(DepthProfile, IsTheDepthThatTheCanopyHas) {
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_of(trial, 1.2);
  const Lattice lattice = lattice_of(trial, raster);
  for (const DepthProfile& profile :
       {profile_of(lattice, lattice.places[2], 1.8), pooled_profile(lattice, 1.8)}) {
    ASSERT_GT(profile.x_m.size(), 70U);
    expect_depths_of_box(profile, 1.2, 3);
    EXPECT_NEAR(plateau_depth(profile, 3), 1.2, 0.02);
  }
}

// Along c as well, of the lattice turned.
TEST(DepthProfile, SeesPlotsAcross) {
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_of(trial, 1.2);
  const DepthProfile profile = pooled_profile(lattice_of(trial, raster).turned(), 0.9);
  expect_depths_of_box(profile, 1.2, 1.5);
}

// Of what light passes, not of depths: half of a plot without canopy passes half the light.
TEST(PlateauDepth, IsThatOfTheMeanTransmission) {
  EXPECT_NEAR(plateau_depth({.x_m = {-0.1, 0.1}, .depth = {0, 3}}, 1),
              -std::log((1 + std::exp(-3)) / 2), 1e-12);
  EXPECT_EQ(plateau_depth({.x_m = {5}, .depth = {3}}, 1), 0);
}

}  // namespace
}  // namespace plotscan::plots
