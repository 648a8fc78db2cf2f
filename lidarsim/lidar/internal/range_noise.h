// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <utility>

namespace plotscan::lidar {

// Gaussian range noise, metres. It depends on the shot's number and not on the order of calls. Two
// neighbouring shots share one draw, which gives two independent numbers.
class RangeNoise {
 public:
  RangeNoise(std::uint64_t seed, double sigma_m) : seed_(seed), sigma_m_(sigma_m) {}

  double of_shot(std::uint64_t shot);
  // The noise of a shot's second return, independent of that of the first.
  double of_second_return(std::uint64_t shot) const;

 private:
  std::uint64_t seed_;
  double sigma_m_;
  std::uint64_t pair_ = std::numeric_limits<std::uint64_t>::max();
  std::pair<double, double> normals_;
};

}  // namespace plotscan::lidar
