// SPDX-License-Identifier: Apache-2.0
#include "heights/height_profile.h"

#include <gtest/gtest.h>

#include "canopies.h"
#include "heights/features.h"

namespace plotscan::heights {
namespace {

TEST(HeightProfile, QuantilesAndSharesAreThoseOfTheArea) {
  HeightProfile profile;
  profile.low_m = 0;
  profile.bin_m = 0.1;
  profile.share = {0.5, 0, 0, 0.25, 0.25};
  EXPECT_NEAR(profile.quantile(0.25), 0.05, 1e-12);
  EXPECT_NEAR(profile.quantile(0.75), 0.4, 1e-12);
  EXPECT_NEAR(profile.share_above(0.2), 0.5, 1e-12);
  EXPECT_NEAR(profile.share_above(0.35), 0.375, 1e-12);
}

// One half of the plot was flown over ten times as often as the other.
TEST(HeightProfile, CountsAreaNotReturns) {
  const PlotBox box = plot_at(0, 0);
  RandomStream random(1, random_purpose("test"), 0);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 22'000; ++i) {
    const bool twice = i % 11 > 0;
    const double along = (twice ? random.uniform(0, 0.5) : random.uniform(-0.5, 0)) * box.length_m;
    const Eigen::Vector2d place = box.center + along * box.length_axis() +
                                  random.uniform(-0.5, 0.5) * box.width_m * box.width_axis();
    points.emplace_back(place.x(), place.y(), twice ? 0.8F : 0.4F);
  }
  const HeightProfile profile = height_profile(box, points, 0.02);
  EXPECT_NEAR(profile.share_above(0.6), 0.5, 0.02);
}

// Of a tilted plane with noise, the quantiles are those of a uniform distribution.
TEST(HeightProfile, WithoutNoiseItIsTheSurfacesOwn) {
  const PlotBox box = plot_at(1, 2);
  constexpr double kSpread_m = 0.03;
  RandomStream random(2, random_purpose("test"), 0);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 40'000; ++i) {
    const double along = random.uniform(-0.5, 0.5);
    const Eigen::Vector2d place = box.center + along * box.length_m * box.length_axis() +
                                  random.uniform(-0.5, 0.5) * box.width_m * box.width_axis();
    points.emplace_back(place.x(), place.y(), 1 + 0.5 * along + kSpread_m * random.normal());
  }
  const HeightProfile noisy = height_profile(box, points, 5 * kSpread_m);
  const HeightProfile profile = without_noise(noisy, kSpread_m);
  for (const double share : {0.05, 0.5, 0.95, 0.99})
    EXPECT_NEAR(profile.quantile(share), 0.75 + 0.5 * share, 0.006) << share;
  EXPECT_GT(noisy.quantile(0.99), 0.75 + 0.5 * 0.99 + 0.012);
}

}  // namespace
}  // namespace plotscan::heights
