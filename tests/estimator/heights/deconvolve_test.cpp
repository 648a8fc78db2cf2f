// SPDX-License-Identifier: Apache-2.0
#include "heights/internal/deconvolve.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace plotscan::heights {
namespace {

double normal_below(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// Mass per bin of a uniform distribution over [100, 200) blurred by a Gaussian, in closed form.
std::vector<double> blurred_uniform(double sigma) {
  const auto integral = [&](double x) {  // of the normal distribution function
    const double z = x / sigma;
    return sigma * (z * normal_below(z) + std::exp(-0.5 * z * z) / std::sqrt(2 * M_PI));
  };
  std::vector<double> mass;
  for (int bin = 0; bin < 300; ++bin) {
    const double a = bin - 100;
    const double b = bin - 200;
    mass.push_back((integral(a + 1) - integral(a) - integral(b + 1) + integral(b)) / 100);
  }
  return mass;
}

double quantile_of(const std::vector<double>& mass, double share) {
  double below = 0;
  for (std::size_t bin = 0; bin < mass.size(); ++bin) {
    if (below + mass[bin] >= share) return static_cast<double>(bin) + (share - below) / mass[bin];
    below += mass[bin];
  }
  return static_cast<double>(mass.size());
}

TEST(Deconvolve, TakesTheBlurOutOfAUniformDistribution) {
  const std::vector<double> blurred = blurred_uniform(6);
  const std::vector<double> sharp = deconvolve(blurred, 6);
  EXPECT_NEAR(std::accumulate(sharp.begin(), sharp.end(), 0.0), 1, 1e-3);
  for (const double share : {0.01, 0.1, 0.5, 0.9, 0.99}) {
    const double truth = 100 + 100 * share;
    EXPECT_NEAR(quantile_of(sharp, share), truth, 0.8) << share;
  }
  // The blurred one is off by more.
  EXPECT_GT(quantile_of(blurred, 0.99) - 199, 3);
}

TEST(Deconvolve, LeavesWhatIsNotBlurred) {
  const std::vector<double> mass = {0, 0.2, 0.5, 0.3, 0};
  EXPECT_EQ(deconvolve(mass, 0), mass);
}

TEST(Deconvolve, NarrowsAGaussianToItsOwnWidth) {
  // A Gaussian of sigma 5 blurred by one of sigma 5 has sigma 7.07.
  std::vector<double> mass;
  const double wide = std::sqrt(50.0);
  for (int bin = 0; bin < 120; ++bin)
    mass.push_back(normal_below((bin + 1 - 60) / wide) - normal_below((bin - 60) / wide));
  const std::vector<double> sharp = deconvolve(mass, 5);
  double variance = 0;
  for (std::size_t bin = 0; bin < sharp.size(); ++bin)
    variance += sharp[bin] * std::pow(static_cast<double>(bin) + 0.5 - 60, 2);
  EXPECT_NEAR(std::sqrt(variance), 5, 0.3);
}

}  // namespace
}  // namespace plotscan::heights
