// SPDX-License-Identifier: Apache-2.0
#include "lidar/internal/range_noise.h"

#include "core/random.h"

namespace plotscan::lidar {

double RangeNoise::of_shot(std::uint64_t shot) {
  if (sigma_m_ == 0) return 0;
  if (shot / 2 != pair_) {
    pair_ = shot / 2;
    normals_ = RandomStream(seed_, random_purpose("range noise"), pair_).normal_pair();
  }
  return sigma_m_ * (shot % 2 == 0 ? normals_.first : normals_.second);
}

double RangeNoise::of_second_return(std::uint64_t shot) const {
  if (sigma_m_ == 0) return 0;
  return sigma_m_ * RandomStream(seed_, random_purpose("range noise/second return"), shot).normal();
}

}  // namespace plotscan::lidar
