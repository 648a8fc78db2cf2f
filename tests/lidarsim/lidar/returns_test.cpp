// SPDX-License-Identifier: Apache-2.0
#include "lidar/returns.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace plotscan::lidar {
namespace {

// Pulses of 6 ns merge within 0.764 m; 10 % at 50 m is just detected.
constexpr sensor::Beam kWideBeam = {.along_rad = 3e-3,
                                    .across_rad = 1.5e-3,
                                    .pulse_s = 6e-9,
                                    .faintest_reflectance = 0.1,
                                    .faintest_range_m = 50,
                                    .least_separation_m = 1};

std::vector<Hit> operator*(int count, const Hit& hit) {
  return std::vector<Hit>(static_cast<std::size_t>(count), hit);
}

std::vector<Hit> operator+(std::vector<Hit> a, const std::vector<Hit>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Hit facing(float range_m, float reflectance, std::uint32_t surface = 0) {
  return {.range_m = range_m, .cos_incidence = 1, .reflectance = reflectance, .surface = surface};
}

Hit nothing() { return facing(std::numeric_limits<float>::infinity(), 0); }

std::vector<Return> detect(const std::vector<Hit>& hits, ReturnMode mode) {
  Detector detector(kWideBeam, mode);
  const auto returns = detector.detect(hits);
  return {returns.begin(), returns.end()};
}

TEST(Returns, FilledBeamReturnsItsReflectance) {
  for (const float range_m : {0.5f, 8.0f, 25.0f}) {
    const auto returns = detect(9 * facing(range_m, 0.45f, 3), ReturnMode::strongest);
    ASSERT_EQ(returns.size(), 1u);
    EXPECT_NEAR(returns[0].range_m, range_m, 1e-6);
    EXPECT_EQ(returns[0].intensity, 45);
    EXPECT_EQ(returns[0].hit.surface, 3u);
  }
  Hit oblique = facing(8, 0.45f);
  oblique.cos_incidence = 0.8f;
  EXPECT_EQ(detect(5 * oblique, ReturnMode::strongest)[0].intensity, 36);
}

TEST(Returns, PartlyCoveredBeamReturnsItsShare) {
  const auto returns = detect(3 * facing(8, 0.4f) + 7 * nothing(), ReturnMode::strongest);
  ASSERT_EQ(returns.size(), 1u);
  EXPECT_EQ(returns[0].intensity, 12);
  EXPECT_TRUE(detect(10 * nothing(), ReturnMode::strongest).empty());
  EXPECT_TRUE(detect(10 * facing(8, 0), ReturnMode::strongest).empty());
}

// Brighter than a white diffuse surface, as a retroreflector.
TEST(Returns, IntensityEndsAt255) {
  EXPECT_EQ(detect(4 * facing(8, 9), ReturnMode::strongest)[0].intensity, 255);
}

// A metre is two pulses apart: half the energy each, and the nearer half is the stronger.
TEST(Returns, HalfCoveredBeamReturnsTwice) {
  const auto hits = 8 * facing(8, 0.4f, 1) + 8 * facing(10, 0.4f, 2);
  const auto both = detect(hits, ReturnMode::dual);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NEAR(both[0].range_m, 8, 1e-4);
  EXPECT_NEAR(both[1].range_m, 10, 1e-4);
  for (const Return& each : both) EXPECT_EQ(each.intensity, 20);
  EXPECT_EQ(both[0].hit.surface, 1u);
  EXPECT_EQ(both[1].hit.surface, 2u);
  const auto strongest = detect(hits, ReturnMode::strongest);
  ASSERT_EQ(strongest.size(), 1u);
  EXPECT_NEAR(strongest[0].range_m, 8, 1e-4);
  const auto last = detect(hits, ReturnMode::last);
  ASSERT_EQ(last.size(), 1u);
  EXPECT_NEAR(last[0].range_m, 10, 1e-4);
}

// The mixed pixel: one return between the surfaces, at the mean of their ranges by power.
TEST(Returns, SurfacesCloserThanThePulseGiveOneBetween) {
  const auto returns =
      detect(10 * facing(8, 0.3f, 1) + 10 * facing(8.2f, 0.3f, 2), ReturnMode::dual);
  ASSERT_EQ(returns.size(), 1u);
  const double near = 1 / 64.0;
  const double far = 1 / (8.2 * 8.2);
  EXPECT_NEAR(returns[0].range_m, (8 * near + 8.2 * far) / (near + far), 2e-4);
  EXPECT_EQ(returns[0].intensity, 30);
  EXPECT_EQ(returns[0].hit.surface, 1u);
}

TEST(Returns, LabelsAreOfTheSurfaceWithMostEnergy) {
  // No hit is stronger than the one on surface 7; together those on surface 5 are.
  const auto returns =
      detect(4 * facing(8, 0.3f, 5) + 1 * facing(8.1f, 0.9f, 7), ReturnMode::strongest);
  EXPECT_EQ(returns[0].hit.surface, 5u);
}

TEST(Returns, CloserThanTheLeastSeparationTheStrongerCounts) {
  for (const ReturnMode mode : {ReturnMode::strongest, ReturnMode::last, ReturnMode::dual}) {
    const auto returns = detect(4 * facing(8, 0.3f, 1) + 6 * facing(8.95f, 0.3f, 2), mode);
    ASSERT_EQ(returns.size(), 1u);
    EXPECT_EQ(returns[0].hit.surface, 2u);
  }
}

// Overlapping pulses pull their maxima together: of two equal echoes a distance 2 a apart they are
// 2 x apart, x = a tanh(a x / sigma^2). The least separation is of the maxima: 2 x = 1 m.
TEST(Returns, LeastSeparationIsOfTheMaxima) {
  const double sigma_m = 0.5 * 299'792'458 * kWideBeam.pulse_s / (2 * std::sqrt(2 * std::log(2)));
  const double x = 0.5 * kWideBeam.least_separation_m;
  double a = x;
  for (int i = 0; i < 1000; ++i) a = x / std::tanh(a * x / (sigma_m * sigma_m));
  const auto returns = [](double apart_m) {
    const double far_m = 8 + apart_m;
    return detect(5 * facing(8, 0.3f) + 5 * facing(static_cast<float>(far_m),
                                                   static_cast<float>(0.3 * far_m * far_m / 64)),
                  ReturnMode::dual)
        .size();
  };
  EXPECT_GT(2 * a, 1.05);
  EXPECT_EQ(returns(2 * a - 0.001), 1u);
  EXPECT_EQ(returns(2 * a + 0.001), 2u);
}

// Dual: strongest and last; where the last is the strongest, the second strongest and it.
TEST(Returns, DualOfThreeSurfaces) {
  const auto ranges = [](int first, int second, int third) {
    std::vector<double> found;
    for (const Return& each :
         detect(first * facing(8, 0.3f) + second * facing(10, 0.3f) + third * facing(12, 0.3f),
                ReturnMode::dual))
      found.push_back(std::round(each.range_m));
    return found;
  };
  EXPECT_EQ(ranges(10, 4, 4), (std::vector<double>{8, 12}));
  EXPECT_EQ(ranges(2, 10, 4), (std::vector<double>{10, 12}));
  EXPECT_EQ(ranges(2, 6, 40), (std::vector<double>{10, 12}));
  EXPECT_EQ(ranges(6, 2, 40), (std::vector<double>{8, 12}));
}

// A facing surface of reflectance rho that fills a share of the beam is detected up to
// 50 m sqrt(rho share / 0.1).
TEST(Returns, FaintEchoesAreNotDetected) {
  for (const int covered : {1, 3, 12}) {
    for (const double reflectance : {0.05, 0.3, 0.9}) {
      const double reach_m = 50 * std::sqrt(reflectance * covered / 12 / 0.1);
      const auto count = [&](double range_m) {
        const Hit hit = facing(static_cast<float>(range_m), static_cast<float>(reflectance));
        return detect(covered * hit + (12 - covered) * nothing(), ReturnMode::last).size();
      };
      EXPECT_EQ(count(0.999 * reach_m), 1u);
      EXPECT_EQ(count(1.001 * reach_m), 0u);
    }
  }
}

}  // namespace
}  // namespace plotscan::lidar
