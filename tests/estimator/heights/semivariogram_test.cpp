// SPDX-License-Identifier: Apache-2.0
#include "heights/internal/semivariogram.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::heights {
namespace {

const PlotBox kBox{.center = {3, -2}, .width_m = 1.5, .length_m = 4, .heading_rad = 0.4};
constexpr double kTop_m = 0.5;
const std::size_t kLags = kLags_m.size();

// So many returns a square metre of the box, at a height by their place, with normal noise.
std::vector<Eigen::Vector3f> returns_of(
    const std::function<double(const Eigen::Vector2d&)>& height_m, double density_m2,
    double noise_m = 0) {
  RandomStream random(7, random_purpose("test"), 0);
  std::vector<Eigen::Vector3f> points;
  const auto count = static_cast<std::size_t>(density_m2 * kBox.area_m2());
  while (points.size() < count) {
    const Eigen::Vector2d place = kBox.center +
                                  random.uniform(-0.5, 0.5) * kBox.length_m * kBox.length_axis() +
                                  random.uniform(-0.5, 0.5) * kBox.width_m * kBox.width_axis();
    points.emplace_back(place.x(), place.y(), height_m(place) + noise_m * random.normal());
  }
  std::ranges::sort(points, std::greater(), [](const auto& point) { return point.z(); });
  return points;
}

std::vector<double> values_of(const std::vector<Eigen::Vector3f>& points, double noise_m = 0) {
  return relative_semivariances(kBox, points, kTop_m, noise_m);
}

// Heights of waves of random heading: semivariance of a sine of wave number k and amplitude a over
// all headings is a^2 / 2 (1 - J0(k h)), here averaged over the lags' rings by quadrature.
double of_waves(double wave_number, double lag_m) {
  constexpr int kSteps = 1000;
  double sum = 0, area = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double h = lag_m * (0.7 + 0.7 * (i + 0.5) / kSteps);
    sum += h * (1 - std::cyl_bessel_j(0, wave_number * h));
    area += h;
  }
  return sum / area;
}

double waves(const Eigen::Vector2d& place, double wave_number) {
  constexpr int kWaves = 24;
  double sum = 0;
  for (int i = 0; i < kWaves; ++i) {
    const double heading = std::numbers::pi * (i + 0.5) / kWaves;
    sum += std::sin(wave_number * (std::cos(heading) * place.x() + std::sin(heading) * place.y()) +
                    2.4 * i * i);
  }
  return 0.4 + 0.02 * sum;
}

TEST(Semivariogram, IsThatOfASurfaceOfWaves) {
  constexpr double kWaveNumber = 2 * std::numbers::pi / 0.4;
  const auto points =
      returns_of([](const Eigen::Vector2d& p) { return waves(p, kWaveNumber); }, 6000);
  const std::vector<double> values = values_of(points);
  for (std::size_t lag = 0; lag < kLags; ++lag)
    EXPECT_NEAR(values[lag], of_waves(kWaveNumber, kLags_m[lag]) / of_waves(kWaveNumber, 0.32),
                0.04)
        << kLags_m[lag];
}

TEST(Semivariogram, NoiseIsTakenOutOfIt) {
  const auto surface = [](const Eigen::Vector2d& p) { return waves(p, 12); };
  const std::vector<double> clean = values_of(returns_of(surface, 4000));
  const std::vector<double> noisy = values_of(returns_of(surface, 4000, 0.03), 0.03);
  for (std::size_t lag = 0; lag < kLags; ++lag) EXPECT_NEAR(noisy[lag], clean[lag], 0.05) << lag;
}

// Heights of no order at all: every lag differs as much as the far one.
TEST(Semivariogram, IsFlatForStraws) {
  RandomStream random(3, random_purpose("straws"), 0);
  const std::vector<double> values =
      values_of(returns_of([&](const Eigen::Vector2d&) { return random.uniform(0.1, 0.5); }, 3000));
  for (const double value : values) EXPECT_NEAR(value, 1, 0.08);
}

TEST(Semivariogram, DoesNotChangeWithTheDensity) {
  const auto surface = [](const Eigen::Vector2d& p) { return waves(p, 20); };
  const std::vector<double> dense = values_of(returns_of(surface, 20000));
  const std::vector<double> sparse = values_of(returns_of(surface, 600));
  for (std::size_t lag = 0; lag < kLags; ++lag) EXPECT_NEAR(sparse[lag], dense[lag], 0.08) << lag;
}

// Stubble between the leaves, without any order, counts in the values of all returns only.
TEST(Semivariogram, OfAPartComparesTheReturnsOfThatPart) {
  const auto canopy = [](const Eigen::Vector2d& p) { return 0.44 + 0.5 * (waves(p, 12) - 0.4); };
  std::vector<Eigen::Vector3f> points = returns_of(canopy, 4000);
  const std::vector<double> alone = values_of(points);
  RandomStream random(5, random_purpose("stubble"), 0);
  const std::vector<Eigen::Vector3f> stubble =
      returns_of([&](const Eigen::Vector2d&) { return random.uniform(0, 0.19); }, 1500);
  points.insert(points.end(), stubble.begin(), stubble.end());
  std::ranges::sort(points, std::greater(), [](const auto& point) { return point.z(); });
  const std::vector<double> both = values_of(points);
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    EXPECT_GT(both[lag], alone[lag] + 0.1) << lag;
    EXPECT_NEAR(both[kLags + lag], alone[kLags + lag], 0.05) << lag;
    EXPECT_NEAR(both[2 * kLags + lag], alone[2 * kLags + lag], 0.05) << lag;
  }
}

TEST(Semivariogram, AFlatOrNearlyEmptyPlotHasNeutralValues) {
  for (const double value : values_of(returns_of([](const Eigen::Vector2d&) { return 0.3; }, 2000)))
    EXPECT_EQ(value, 1);
  for (const double value : values_of(returns_of([](const Eigen::Vector2d&) { return 0.3; }, 1)))
    EXPECT_EQ(value, 1);
}

TEST(Semivariogram, HasANameForEveryValue) {
  const auto names = semivariance_names();
  EXPECT_EQ(names.size(), kLags * kPairsAbove.size());
  EXPECT_EQ(names.front(), "semivariance2");
  EXPECT_EQ(names.back(), "semivariance16_above70");
}

}  // namespace
}  // namespace plotscan::heights
