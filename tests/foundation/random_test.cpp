// SPDX-License-Identifier: Apache-2.0
#include "core/random.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace plotscan {
namespace {

TEST(RandomStream, IsTheReferencePhilox) {
  // Random123's known answer for philox4x32-10 with all-zero counter and key (kat_vectors).
  RandomStream stream(0, 0, 0);
  EXPECT_EQ(stream.next_u32(), 0x6627e8d5u);
  EXPECT_EQ(stream.next_u32(), 0xe169c58du);
  EXPECT_EQ(stream.next_u32(), 0xbc57ac4cu);
  EXPECT_EQ(stream.next_u32(), 0x9b00dbd8u);
}

TEST(RandomStream, DependsOnSeedPurposeAndIndexOnly) {
  const auto first = [](std::uint64_t seed, const char* what, std::uint64_t index) {
    return RandomStream(seed, random_purpose(what), index).next_u64();
  };
  EXPECT_EQ(first(1, "a", 2), first(1, "a", 2));
  const std::set<std::uint64_t> values{first(1, "a", 2),          first(2, "a", 2),
                                       first(1, "b", 2),          first(1, "a", 3),
                                       first(1ull << 40, "a", 2), first(1, "a", 1ull << 40)};
  EXPECT_EQ(values.size(), 6u);
}

TEST(RandomStream, NormalNumbersHaveUnitVarianceAndTheRightTail) {
  constexpr int kCount = 200'000;
  double sum = 0;
  double squares = 0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double value = RandomStream(3, random_purpose("test"), i).normal();
    sum += value;
    squares += value * value;
    beyond_two += std::abs(value) > 2;
  }
  EXPECT_NEAR(sum / kCount, 0, 5 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1, 5 * std::sqrt(2.0 / kCount));
  const double tail = std::erfc(2 / std::sqrt(2.0));
  EXPECT_NEAR(beyond_two / double{kCount}, tail, 5 * std::sqrt(tail / kCount));
}

TEST(RandomStream, BelowCoversItsRangeEvenly) {
  int counts[5] = {};
  for (int i = 0; i < 50'000; ++i) ++counts[RandomStream(9, random_purpose("die"), i).below(5)];
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 500);
}

}  // namespace
}  // namespace plotscan
