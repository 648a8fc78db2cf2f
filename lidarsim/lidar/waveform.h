// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace plotscan::lidar {

// The echo of one sub-ray.
struct Echo {
  double range_m = 0;
  double power = 0;  // at its pulse's maximum
};

// A maximum of the received power.
struct Peak {
  double range_m = 0;
  double power = 0;
  std::size_t begin = 0;  // its echoes: [begin, end), those between the minima beside it
  std::size_t end = 0;
};

// The maxima of the sum of the echoes' pulses, Gaussians of standard deviation `sigma_m` in range,
// from near to far. The echoes are sorted by range. Where all of them lie within kOnePeak there is
// one maximum (the sum is then log-concave); otherwise the sign of the slope is sampled every
// eighth of sigma, so that a narrower dip is not seen. A maximum's range is found to a micrometre.
std::vector<Peak> find_peaks(std::span<const Echo> echoes, double sigma_m);

// Echoes that all lie within this many sigmas have a single maximum.
inline constexpr double kOnePeak = 2;
// The maximum of echoes within kOnePeak, in any order.
Peak only_peak(std::span<const Echo> echoes, double nearest_m, double farthest_m, double sigma_m);

}  // namespace plotscan::lidar
