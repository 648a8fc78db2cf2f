// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace plotscan::heights {

inline constexpr int kDeconvolveIterations = 60;

// The non-negative distribution that, blurred by a Gaussian of sigma_bins, comes closest to
// `blurred`: Richardson-Lucy iterations (Richardson 1972; Lucy 1974), which increase the likelihood
// of counts and keep their sum. Mass within 4 sigma of either end of the array is partly lost:
// leave that much room. With a sigma below half a bin the distribution is returned as it is.
std::vector<double> deconvolve(std::span<const double> blurred, double sigma_bins,
                               int iterations = kDeconvolveIterations);

}  // namespace plotscan::heights
