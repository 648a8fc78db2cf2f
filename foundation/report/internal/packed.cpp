// SPDX-License-Identifier: Apache-2.0
#include "report/internal/packed.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <zlib.h>

#include "core/error.h"

namespace plotscan::report {
namespace {

constexpr std::uint16_t kNone = 65535;

}  // namespace

void append_differences(Bytes& bytes, std::span<const std::uint16_t> numbers) {
  const std::size_t first = bytes.size();
  bytes.resize(first + 2 * numbers.size());
  std::uint16_t last = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto difference = static_cast<std::int16_t>(numbers[i] - last);
    const auto folded = static_cast<std::uint16_t>((difference * 2) ^ (difference < 0 ? -1 : 0));
    bytes[first + i] = static_cast<std::uint8_t>(folded & 255);
    bytes[first + numbers.size() + i] = static_cast<std::uint8_t>(folded >> 8);
    last = numbers[i];
  }
}

Bytes deflated(const Bytes& bytes) {
  // Level 4 packs a scan's points within 3 % of level 6, in a third of the time.
  constexpr int kLevel = 4;
  uLongf size = compressBound(bytes.size());
  Bytes packed(size);
  const int result = compress2(packed.data(), &size, bytes.data(), bytes.size(), kLevel);
  check(result == Z_OK, "zlib refuses a buffer of the size that it asked for");
  packed.resize(size);
  return packed;
}

nlohmann::json packed_numbers(std::span<const float> numbers, double step) {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const float number : numbers) {
    if (!std::isfinite(number)) continue;
    low = std::min<double>(low, number);
    high = std::max<double>(high, number);
  }
  if (low > high) low = high = 0;
  while ((high - low) / step > kNone - 1.5) step *= 2;
  std::vector<std::uint16_t> whole(numbers.size(), kNone);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (std::isfinite(numbers[i]))
      whole[i] = static_cast<std::uint16_t>(std::lround((numbers[i] - low) / step));
  Bytes bytes;
  append_differences(bytes, whole);
  return {{"n", numbers.size()},
          {"low", low},
          {"step", step},
          {"data", nlohmann::json::binary(deflated(bytes))}};
}

}  // namespace plotscan::report
