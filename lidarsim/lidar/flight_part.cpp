// SPDX-License-Identifier: Apache-2.0
#include "lidar/flight_part.h"

#include <algorithm>

#include "core/error.h"
#include "core/parse.h"

namespace plotscan::lidar {

FlightPart flight_part(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string of = text.substr(std::min(slash + 1, text.size()));
  const FlightPart part{.number = parsed<int>(text.substr(0, slash)).value_or(0),
                        .of = parsed<int>(of).value_or(0)};
  if (part.number < 1 || part.number > part.of || part.of > kMostParts) {
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
