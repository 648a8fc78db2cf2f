// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace plotscan::lidar {

// One of the equally long stretches of time that a flight is cut into, to be scanned one by one.
struct FlightPart {
  int number = 1;  // from 1
  int of = 1;      // parts of the flight

  bool whole() const { return of == 1; }
};

inline constexpr int kMostParts = 10'000;

// "2/4" as a part. Throws InputError on anything but I/N with 1 <= I <= N <= kMostParts.
FlightPart flight_part(const std::string& text);

// Firing sequences from `begin` up to, without, `end`.
struct SequenceRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

// Those of the part's of a flight with so many. All parts but the last have a multiple of `step`;
// together they have each sequence once.
SequenceRange sequences_of(const FlightPart& part, std::uint64_t sequences, std::uint64_t step);

}  // namespace plotscan::lidar
