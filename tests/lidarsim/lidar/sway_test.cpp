// SPDX-License-Identifier: Apache-2.0
#include "lidar/sway.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "lidar/internal/bent_stem.h"

namespace plotscan::lidar {
namespace {

flight::WindOptions steady_wind(double mean_m_s) {
  return {.mean_m_s = mean_m_s, .turbulence = 0, .seed = 5};
}

Crop field() {
  return {.height_m = 0.8, .feet_m = {Eigen::Vector2d(-20, -10), Eigen::Vector2d(20, 10)}};
}

// The links' slopes grow evenly, so that their ends lie on a circle through the foot whose chord is
// a link: the closed form of the sum of sines and of cosines.
Eigen::Vector2d chain_end(double height_m, double lean_rad, int links) {
  const double link_m = height_m / BentStem::kLinks;
  const double turn = 2 * lean_rad / BentStem::kLinks;
  const double radius_m = link_m / (2 * std::sin(turn / 2));
  return {radius_m * (1 - std::cos(links * turn)), radius_m * std::sin(links * turn)};
}

TEST(BentStem, EndsOfLinksLieOnACircle) {
  for (const double lean : {0.01, 0.2, 0.69}) {
    const Eigen::Vector2d direction(0.6, -0.8);
    const BentStem stem(1.7f, (lean * direction).cast<float>());
    for (int i = 1; i <= BentStem::kLinks; ++i) {
      const float rest_m = 1.7f * static_cast<float>(i) / BentStem::kLinks;
      const Eigen::Vector3f bent = stem.bent({0, 0, rest_m});
      const Eigen::Vector2d expected = chain_end(1.7, lean, i);
      EXPECT_NEAR(bent.x(), 0.6 * expected.x(), 2e-6);
      EXPECT_NEAR(bent.y(), -0.8 * expected.x(), 2e-6);
      EXPECT_NEAR(bent.z(), expected.y(), 2e-6);
    }
    const Eigen::Vector3f tip = stem.bent({0, 0, 1.7f});
    EXPECT_NEAR(std::atan2(tip.head<2>().norm(), tip.z()), lean, 1e-5);
    EXPECT_NEAR(tip_reach_m(1.7f, static_cast<float>(lean)), tip.head<2>().norm(), 2e-6);
  }
}

TEST(BentStem, KeepsItsLength) {
  const BentStem stem(0.9f, {0.5f, 0.3f});
  constexpr int kPieces = 8000;
  double length_m = 0;
  Eigen::Vector3f last = stem.bent({0, 0, 0});
  for (int i = 1; i <= kPieces; ++i) {
    const Eigen::Vector3f next = stem.bent({0, 0, 0.9f * static_cast<float>(i) / kPieces});
    length_m += (next - last).cast<double>().norm();
    last = next;
  }
  EXPECT_NEAR(length_m, 0.9, 1e-4);
}

// A cantilever: x ~ z^2 near the foot, and the top comes down by 2/3 X^2 / h where it bends little.
TEST(BentStem, BendsAsACantilever) {
  const BentStem stem(1, {0.05f, 0});
  const Eigen::Vector3f tip = stem.bent({0, 0, 1});
  const Eigen::Vector3f half = stem.bent({0, 0, 0.5f});
  EXPECT_NEAR(half.x() / tip.x(), 0.25, 1e-3);
  EXPECT_NEAR(1 - tip.z(), 2.0 / 3 * tip.x() * tip.x(), 0.02 * (1 - tip.z()));
}

TEST(BentStem, WithoutLeanAllStaysWhereItIs) {
  const BentStem stem(1, {0, 0});
  for (const Eigen::Vector3f& place :
       {Eigen::Vector3f(0.1f, 0.2f, -0.1f), Eigen::Vector3f(0.3f, 0.2f, 0.4f),
        Eigen::Vector3f(-0.1f, 0.2f, 1.0f)})
    EXPECT_LT((stem.bent(place) - place).norm(), 1e-6f);
}

TEST(Sway, StandsStillWithoutWind) {
  const Sway sway({}, steady_wind(0), 60, field());
  const Sway::Motion motion = sway.motion_of(3, {4, 5}, 0.8);
  for (double time_s = 0; time_s < 60; time_s += 0.7)
    EXPECT_EQ(sway.lean_rad(motion, time_s), Eigen::Vector2d(0, 0));
  EXPECT_EQ(sway.greatest_lean_rad(motion), 0);
}

// The logarithmic profile, from its definition at the two heights.
TEST(Sway, WindAtTheTopFollowsTheLogarithmicProfile) {
  const double friction_m_s = 0.4;
  const auto profile = [&](double z_m) {
    return friction_m_s / 0.41 * std::log((z_m - 0.67 * 0.9) / (0.1 * 0.9));
  };
  EXPECT_NEAR(canopy_wind_share(0.9, 8), profile(0.9) / profile(8), 1e-12);
  EXPECT_EQ(canopy_wind_share(3, 2.5), 1);
}

// Which a wind that blows steadily at the plant's top itself leans by what is stated.
TEST(Sway, LeansDownwindAsFarAsStated) {
  flight::WindOptions wind = steady_wind(5);
  wind.height_m = 0.8;
  wind.from_deg = 300;
  const Sway sway({.lean_deg_at_5m_s = 4, .swing = 0}, wind, 60, field());
  const Eigen::Vector2d lean = sway.lean_rad(sway.motion_of(1, {0, 0}, 0.8), 10);
  const double expected = kMaxLean_rad * std::tanh(radians(4) / kMaxLean_rad);
  EXPECT_NEAR(lean.norm(), expected, 1e-12);
  // From 300 degrees clockwise from north: to 120, east-south-east.
  EXPECT_NEAR(lean.x() / lean.norm(), std::sin(radians(120)), 1e-12);
  EXPECT_NEAR(lean.y() / lean.norm(), std::cos(radians(120)), 1e-12);
}

TEST(Sway, SwingsAtItsFrequencyByHeight) {
  const Sway sway({.hz_at_1m = 1.3}, steady_wind(6), 200, field());
  for (const double height_m : {0.25, 1.0, 2.3}) {
    const Sway::Motion motion = sway.motion_of(9, {1, 2}, height_m);
    const double mean = (sway.greatest_lean_rad(motion)) / std::hypot(1.5, 0.5 / 3);
    int upward = 0;
    double last = sway.lean_rad(motion, 0).x() - mean;
    for (double time_s = 0.001; time_s < 100; time_s += 0.001) {
      const double now = sway.lean_rad(motion, time_s).x() - mean;
      if (last < 0 && now >= 0) ++upward;
      last = now;
    }
    EXPECT_NEAR(upward / 100.0, 1.3 / std::sqrt(height_m), 0.02) << height_m;
  }
}

TEST(Sway, EveryPlantHasAPhaseOfItsOwn) {
  const Sway sway({}, steady_wind(6), 60, field());
  double cosines = 0;
  double sines = 0;
  for (std::uint32_t plant = 1; plant <= 1000; ++plant) {
    const Sway::Motion motion = sway.motion_of(plant, {0, 0}, 0.8);
    cosines += std::cos(motion.along_rad);
    sines += std::sin(motion.along_rad);
  }
  // Random phases: the mean vector is Rayleigh, 0.1 has a chance of exp(-10).
  EXPECT_LT(std::hypot(cosines, sines) / 1000, 0.1);
}

// A gust comes to a plant downwind later, by the way over 1.8 times the wind at the crop's top.
TEST(Sway, GustsTravelOverTheField) {
  flight::WindOptions wind = steady_wind(6);
  wind.turbulence = 0.3;
  const Sway sway({.swing = 0}, wind, 60, field());
  const Sway::Motion upwind = sway.motion_of(1, {-15, 0}, 0.8);
  const Sway::Motion downwind = sway.motion_of(1, {15, 0}, 0.8);
  const double later_s = 30 / (1.8 * 6 * canopy_wind_share(0.8, 8));
  double changes = 0;
  for (double time_s = 0; time_s < 40; time_s += 0.37) {
    const Eigen::Vector2d there = sway.lean_rad(upwind, time_s);
    EXPECT_LT((sway.lean_rad(downwind, time_s + later_s) - there).norm(), 1e-9);
    changes = std::max(changes, (sway.lean_rad(downwind, time_s) - there).norm());
    EXPECT_LE(there.norm(), sway.greatest_lean_rad(upwind));
  }
  EXPECT_GT(changes, 1e-3);
}

TEST(Sway, NeverLeansFurtherThanItsBound) {
  flight::WindOptions storm = steady_wind(30);
  storm.turbulence = 1;
  const Sway sway({.lean_deg_at_5m_s = 40, .swing = 1}, storm, 30, field());
  for (std::uint32_t plant = 0; plant < 20; ++plant) {
    const Sway::Motion motion = sway.motion_of(plant, {plant - 10.0, 3}, 0.8);
    const double bound = sway.greatest_lean_rad(motion);
    EXPECT_LE(bound, kMaxLean_rad);
    for (double time_s = 0; time_s < 30; time_s += 0.05)
      EXPECT_LE(sway.lean_rad(motion, time_s).norm(), bound + 1e-12);
  }
}

}  // namespace
}  // namespace plotscan::lidar
