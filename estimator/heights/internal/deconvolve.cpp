// SPDX-License-Identifier: Apache-2.0
#include "heights/internal/deconvolve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace plotscan::heights {
namespace {

constexpr double kReachSigmas = 4;
constexpr double kLeastSigma = 0.5;

// Half of a Gaussian over whole bins: element k is the mass k bins from the centre, k from 0.
std::vector<double> half_kernel(double sigma_bins) {
  const auto reach = static_cast<std::size_t>(std::ceil(kReachSigmas * sigma_bins));
  const double scale = 1 / (sigma_bins * std::numbers::sqrt2);
  std::vector<double> kernel;
  for (std::size_t k = 0; k <= reach; ++k) {
    const auto distance = static_cast<double>(k);
    kernel.push_back(0.5 *
                     (std::erf((distance + 0.5) * scale) - std::erf((distance - 0.5) * scale)));
  }
  const double total = 2 * std::accumulate(kernel.begin(), kernel.end(), 0.0) - kernel.front();
  for (double& mass : kernel) mass /= total;
  return kernel;
}

std::vector<double> blur(const std::vector<double>& values, const std::vector<double>& kernel) {
  const std::size_t size = values.size();
  std::vector<double> blurred(size, 0);
  for (std::size_t i = 0; i < size; ++i) {
    if (values[i] == 0) continue;
    const std::size_t first = i >= kernel.size() ? i - kernel.size() + 1 : 0;
    const std::size_t last = std::min(size - 1, i + kernel.size() - 1);
    for (std::size_t k = first; k <= last; ++k)
      blurred[k] += values[i] * kernel[k > i ? k - i : i - k];
  }
  return blurred;
}

}  // namespace

std::vector<double> deconvolve(std::span<const double> blurred, double sigma_bins, int iterations) {
  std::vector<double> estimate(blurred.begin(), blurred.end());
  if (sigma_bins < kLeastSigma || blurred.empty()) return estimate;
  const std::vector<double> kernel = half_kernel(sigma_bins);
  const double total = std::accumulate(estimate.begin(), estimate.end(), 0.0);
  std::ranges::fill(estimate, total / static_cast<double>(estimate.size()));
  for (int iteration = 0; iteration < iterations; ++iteration) {
    std::vector<double> ratio = blur(estimate, kernel);
    for (std::size_t i = 0; i < ratio.size(); ++i)
      ratio[i] = ratio[i] > 0 ? blurred[i] / ratio[i] : 0;
    const std::vector<double> correction = blur(ratio, kernel);
    for (std::size_t i = 0; i < estimate.size(); ++i) estimate[i] *= correction[i];
  }
  return estimate;
}

}  // namespace plotscan::heights
