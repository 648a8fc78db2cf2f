// SPDX-License-Identifier: Apache-2.0
#include "lidar/flight_part.h"

#include <algorithm>
#include <charconv>

#include "core/error.h"

namespace plotscan::lidar {

FlightPart flight_part(const std::string& text) {
  FlightPart part{.number = 0, .of = 0};
  const char* end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, part.number);
  const bool slash = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
  const auto of = slash ? std::from_chars(number.ptr + 1, end, part.of) : number;
  const bool read = slash && of.ec == std::errc() && of.ptr == end;
  if (!read || part.number < 1 || part.number > part.of || part.of > kMostParts) {
    throw InputError("--part \"" + text +
                     "\" must be I/N, such as 1/4: the I-th of N parts, N up to " +
                     std::to_string(kMostParts));
  }
  return part;
}

SequenceRange sequences_of(const FlightPart& part, std::uint64_t sequences, std::uint64_t step) {
  const std::uint64_t steps = (sequences + step - 1) / step;
  const auto of = static_cast<std::uint64_t>(part.of);
  const auto boundary = [&](int parts) {
    return std::min(sequences, steps * static_cast<std::uint64_t>(parts) / of * step);
  };
  return {boundary(part.number - 1), boundary(part.number)};
}

}  // namespace plotscan::lidar
