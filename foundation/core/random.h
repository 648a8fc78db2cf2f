// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include <Random123/philox.h>

#include "core/angle.h"

namespace plotscan {

// A number for the purpose that the text names: its FNV-1a hash. So "plant/yaw" and "plant/scale"
// are different streams, and adding a stream changes no other.
constexpr std::uint32_t random_purpose(std::string_view what) {
  std::uint32_t hash = 2166136261u;
  for (const char c : what) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

// Counter-based random numbers (Philox4x32-10, Salmon et al., SC 2011): the numbers of (seed, what,
// index) are the same whichever thread draws them and whatever was drawn before.
//
//   RandomStream stream(seed, random_purpose("plant/yaw"), plant);
//   const double yaw = stream.uniform(0, 2 * pi);
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint32_t what, std::uint64_t index)
      : key_{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}},
        counter_{{0u, static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32),
                  what}} {}

  std::uint32_t next_u32() {
    if (used_ == 4) {
      block_ = philox_(counter_, key_);
      ++counter_[0];
      used_ = 0;
    }
    return block_[used_++];
  }

  std::uint64_t next_u64() {
    const std::uint64_t high = next_u32();
    return (high << 32) | next_u32();
  }

  // Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(next_u64() >> 11) * 0x1.0p-53; }
  // Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // Uniform integer in [0, count), count > 0 (Lemire's multiply-and-shift; its bias is below count
  // / 2^64).
  std::uint64_t below(std::uint64_t count) {
    return static_cast<std::uint64_t>((static_cast<Uint128>(next_u64()) * count) >> 64);
  }
  // Two independent standard normal numbers (Box-Muller).
  std::pair<double, double> normal_pair() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    const double angle = 2.0 * kPi * uniform();
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }
  double normal() { return normal_pair().first; }

 private:
  __extension__ using Uint128 = unsigned __int128;

  r123::Philox4x32 philox_;
  r123::Philox4x32::key_type key_;
  r123::Philox4x32::ctr_type counter_;
  r123::Philox4x32::ctr_type block_{};
  unsigned used_ = 4;
};

}  // namespace plotscan
