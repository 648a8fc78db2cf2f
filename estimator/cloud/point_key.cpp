// SPDX-License-Identifier: Apache-2.0
#include "cloud/point_key.h"

#include <cmath>

namespace plotscan::cloud {
namespace {

constexpr double kReach_m = 1e9;           // of x and y; a tile's index has 32 bits
constexpr double kReachZ_m = 1 << 21;      // of z; a key has 22 bits for its metres
constexpr std::int64_t kBias_m = 1 << 30;  // makes numbers positive, so that truncation rounds down

constexpr std::uint64_t low_bits(int count) { return (std::uint64_t{1} << count) - 1; }

constexpr int kCellBits = 3;                       // of one axis
constexpr int kPlaceBits = kStepBits - kCellBits;  // of one axis within its cell
constexpr int kMixedBits = 2 * kPlaceBits + kStepBits;
constexpr int kMetreBits = 22;
static_assert(2 * kCellBits + kMixedBits + kMetreBits == 64);

// Whole steps, rounded.
std::uint64_t steps_of(double coordinate_m) {
  constexpr double kBias = static_cast<double>(kBias_m) * kStepsAMetre;
  return static_cast<std::uint64_t>(coordinate_m * kStepsAMetre + (kBias + 0.5));
}
std::int64_t metres_of(std::uint64_t steps) {
  return static_cast<std::int64_t>(steps >> kStepBits) - kBias_m;
}

// A bijection of 36-bit numbers: xors with their own upper half and products with odd numbers, as
// in MurmurHash3's fmix64 (A. Appleby, smhasher, src/MurmurHash3.cpp), which has the second factor;
// the first is 2^64 over the golden ratio. Shifts and width are our choice.
constexpr std::uint64_t kFactors[2] = {0x9e3779b97f4a7c15u & low_bits(kMixedBits),
                                       0xff51afd7ed558ccdu & low_bits(kMixedBits)};
constexpr std::uint64_t mixed(std::uint64_t bits) {
  for (const std::uint64_t factor : kFactors) {
    bits ^= bits >> (kMixedBits / 2);
    bits = bits * factor & low_bits(kMixedBits);
  }
  return bits ^ bits >> (kMixedBits / 2);
}

// Inverse of an odd number modulo 2^64 (each Newton iteration doubles the correct bits).
constexpr std::uint64_t inverse(std::uint64_t odd) {
  std::uint64_t result = odd;
  for (int i = 0; i < 5; ++i) result *= 2 - odd * result;
  return result;
}
constexpr std::uint64_t unmixed(std::uint64_t bits) {
  bits ^= bits >> (kMixedBits / 2);
  for (const int i : {1, 0}) {
    bits = bits * inverse(kFactors[i]) & low_bits(kMixedBits);
    bits ^= bits >> (kMixedBits / 2);
  }
  return bits;
}
static_assert(unmixed(mixed(0x123456789u)) == 0x123456789u);

}  // namespace

bool is_in_reach(const Eigen::Vector3d& point) {
  return std::abs(point.x()) < kReach_m && std::abs(point.y()) < kReach_m &&
         std::abs(point.z()) < kReachZ_m - 1;
}

std::optional<PlacedKey> key_of(const Eigen::Vector3d& point) {
  if (!is_in_reach(point)) return std::nullopt;
  const std::uint64_t x = steps_of(point.x());
  const std::uint64_t y = steps_of(point.y());
  const std::uint64_t z = steps_of(point.z());
  const auto cell = [](std::uint64_t steps) { return steps >> kPlaceBits & low_bits(kCellBits); };
  const auto place = [](std::uint64_t steps) { return steps & low_bits(kPlaceBits); };
  const std::uint64_t places =
      place(x) << (kPlaceBits + kStepBits) | place(y) << kStepBits | (z & low_bits(kStepBits));
  const std::uint64_t metres = z >> kStepBits & low_bits(kMetreBits);
  return PlacedKey{
      {static_cast<std::int32_t>(metres_of(x)), static_cast<std::int32_t>(metres_of(y))},
      (cell(y) << kCellBits | cell(x)) << (kMixedBits + kMetreBits) | mixed(places) << kMetreBits |
          (metres ^ 1u << (kMetreBits - 1))};
}

Eigen::Vector3f point_of(Tile tile, std::uint64_t key, const Eigen::Vector3d& origin) {
  const std::uint64_t places = unmixed(key >> kMetreBits & low_bits(kMixedBits));
  const std::uint64_t cell = key >> (kMixedBits + kMetreBits);
  const std::uint64_t x =
      (cell & low_bits(kCellBits)) << kPlaceBits | places >> (kPlaceBits + kStepBits);
  const std::uint64_t y =
      cell >> kCellBits << kPlaceBits | (places >> kStepBits & low_bits(kPlaceBits));
  const auto metres = static_cast<std::int64_t>(key & low_bits(kMetreBits));
  const Eigen::Vector3d corner(tile.x, tile.y,
                               static_cast<double>(metres - (1 << (kMetreBits - 1))));
  const Eigen::Vector3d steps(static_cast<double>(x), static_cast<double>(y),
                              static_cast<double>(places & low_bits(kStepBits)));
  return (corner - origin + steps / kStepsAMetre).cast<float>();
}

}  // namespace plotscan::cloud
