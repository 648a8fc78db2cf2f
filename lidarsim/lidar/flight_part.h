// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace plotscan::lidar {

// One part of a flight that is cut into parts of equal duration, to be scanned one by one.
struct FlightPart {
  int number = 1;  // from 1
  int of = 1;      // number of parts of the flight

  bool whole() const { return of == 1; }
};

inline constexpr int kMostParts = 10'000;

// "2/4" as a part. Throws InputError on anything but I/N with 1 <= I <= N <= kMostParts.
FlightPart flight_part(const std::string& text);

// The firing sequences [begin, end).
struct SequenceRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

// The firing sequences of one part of a flight that has `sequences` of them. Every part but the
// last has a multiple of `step`; together the parts have each sequence exactly once.
SequenceRange sequences_of(const FlightPart& part, std::uint64_t sequences, std::uint64_t step);

}  // namespace plotscan::lidar
