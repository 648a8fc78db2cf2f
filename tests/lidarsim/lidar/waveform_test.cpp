// SPDX-License-Identifier: Apache-2.0
#include "lidar/waveform.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::lidar {
namespace {

constexpr double kSigma_m = 0.382;

double power_at(const std::vector<Echo>& echoes, double range_m) {
  double power = 0;
  for (const Echo& echo : echoes)
    power += echo.power * std::exp(-0.5 * std::pow((range_m - echo.range_m) / kSigma_m, 2));
  return power;
}

TEST(Waveform, OnePulsePeaksAtItsRange) {
  const auto peaks = find_peaks(std::vector<Echo>{{7.5, 0.2}}, kSigma_m);
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_EQ(peaks[0].range_m, 7.5);
  EXPECT_EQ(peaks[0].power, 0.2);
  EXPECT_TRUE(find_peaks({}, kSigma_m).empty());
}

// Two equal Gaussians have two maxima where they are more than two sigma apart, at +-x of their
// middle with x = a tanh(a x / sigma^2), a half their distance.
TEST(Waveform, TwoEqualPulsesMergeWithinTwoSigma) {
  for (const double sigmas : {0.1, 0.5, 1.0, 1.5, 1.9, 1.999}) {
    const double a = 0.5 * sigmas * kSigma_m;
    const auto peaks = find_peaks(std::vector<Echo>{{9 - a, 1}, {9 + a, 1}}, kSigma_m);
    ASSERT_EQ(peaks.size(), 1u) << sigmas;
    EXPECT_NEAR(peaks[0].range_m, 9, 1e-5);
    EXPECT_NEAR(peaks[0].power, 2 * std::exp(-0.125 * sigmas * sigmas), 1e-9);
    EXPECT_EQ(peaks[0].begin, 0u);
    EXPECT_EQ(peaks[0].end, 2u);
  }
  for (const double sigmas : {2.05, 2.2, 2.5, 3.0, 5.0, 7.0, 50.0}) {
    const double a = 0.5 * sigmas * kSigma_m;
    double x = a;
    for (int i = 0; i < 10000; ++i) x = a * std::tanh(a * x / (kSigma_m * kSigma_m));
    const auto peaks = find_peaks(std::vector<Echo>{{90 - a, 1}, {90 + a, 1}}, kSigma_m);
    ASSERT_EQ(peaks.size(), 2u) << sigmas;
    EXPECT_NEAR(peaks[0].range_m, 90 - x, 1e-5) << sigmas;
    EXPECT_NEAR(peaks[1].range_m, 90 + x, 1e-5) << sigmas;
    EXPECT_EQ(peaks[0].end, 1u);
    EXPECT_EQ(peaks[1].begin, 1u);
  }
}

// Whatever the order of echoes within two sigma; 100 draws against the search among sorted ones.
TEST(Waveform, OnlyPeakIsThatOfTheSortedEchoes) {
  for (std::uint64_t draw = 0; draw < 100; ++draw) {
    RandomStream stream(3, random_purpose("test/only-peak"), draw);
    std::vector<Echo> echoes(1 + draw % 30);
    for (Echo& echo : echoes)
      echo = {stream.uniform(9, 9 + kOnePeak * kSigma_m), stream.uniform(0.1, 1)};
    const auto [nearest, farthest] = std::ranges::minmax(echoes, {}, &Echo::range_m);
    const Peak only = only_peak(echoes, nearest.range_m, farthest.range_m, kSigma_m);
    std::ranges::sort(echoes, {}, &Echo::range_m);
    const auto peaks = find_peaks(echoes, kSigma_m);
    ASSERT_EQ(peaks.size(), 1u);
    EXPECT_NEAR(only.range_m, peaks[0].range_m, 2e-6);
    EXPECT_NEAR(only.power, power_at(echoes, only.range_m), 1e-9);
    for (const double aside_m : {-1e-3, 1e-3})
      EXPECT_GT(only.power, power_at(echoes, only.range_m + aside_m));
    EXPECT_EQ(only.end, echoes.size());
  }
}

// Pulses much closer than their length peak at the mean of their ranges weighted by power.
TEST(Waveform, ClosePulsesPeakAtTheirWeightedMean) {
  const std::vector<Echo> echoes = {{8, 3}, {8.01, 1}, {8.02, 2}};
  const auto peaks = find_peaks(echoes, kSigma_m);
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_NEAR(peaks[0].range_m, (3 * 8 + 8.01 + 2 * 8.02) / 6, 2e-6);
}

// Against every local maximum of the sum on a grid of a tenth of a millimetre.
TEST(Waveform, FindsEveryMaximumOfRandomEchoes) {
  int several = 0;
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    RandomStream stream(7, random_purpose("test/waveform"), trial);
    const double length_m = stream.uniform(0.1, 6);
    std::vector<Echo> echoes(1 + stream.below(20));
    for (Echo& echo : echoes)
      echo = {.range_m = 5 + stream.uniform(0, length_m), .power = stream.uniform(0.01, 1)};
    std::ranges::sort(echoes, {}, &Echo::range_m);
    std::vector<double> maxima;
    constexpr double kStep_m = 1e-4;
    for (double r = echoes.front().range_m - 2 * kStep_m; r < echoes.back().range_m + kStep_m;
         r += kStep_m) {
      const double here = power_at(echoes, r);
      if (here > power_at(echoes, r - kStep_m) && here >= power_at(echoes, r + kStep_m))
        maxima.push_back(r);
    }
    const auto peaks = find_peaks(echoes, kSigma_m);
    ASSERT_EQ(peaks.size(), maxima.size()) << "trial " << trial;
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      ASSERT_NEAR(peaks[i].range_m, maxima[i], 1.01 * kStep_m);
      ASSERT_NEAR(peaks[i].power, power_at(echoes, peaks[i].range_m), 1e-6);
      ASSERT_EQ(peaks[i].begin, i == 0 ? 0 : peaks[i - 1].end);
    }
    ASSERT_EQ(peaks.back().end, echoes.size());
    several += peaks.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(several, 50);
}

}  // namespace
}  // namespace plotscan::lidar
