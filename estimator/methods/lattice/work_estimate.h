// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plotscan::methods::lattice {

// The sizes of a field that determine the work of the method lattice.
struct FieldSize {
  std::uint64_t points = 0;
  double rectangle_m2 = 0;  // around the field
  double density_m2 = 0;    // points in the median square metre
};

struct WorkEstimate {
  double seconds = 0;
  double gigabytes = 0;  // at most resident, 1e9 bytes
};

// Estimates the time and memory that the method lattice takes for a field that was read, from
// measurements on one machine (docs/real-clouds.md): within a factor of two there, a guess on other
// machines.
WorkEstimate estimate_work(const FieldSize& field, int threads);

}  // namespace plotscan::methods::lattice
