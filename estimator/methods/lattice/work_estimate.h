// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plotscan::methods::lattice {

// What the work of the method lattice grows with.
struct FieldSize {
  std::uint64_t points = 0;
  double rectangle_m2 = 0;  // around the field
  double density_m2 = 0;    // points in the median square metre
};

struct WorkEstimate {
  double seconds = 0;
  double gigabytes = 0;  // at most resident, 1e9 bytes
};

// Roughly what the method lattice will take for a field that was read, from growth measured on one
// machine (docs/real-clouds.md): right to a factor of two there, a guess on others.
WorkEstimate estimate_work(const FieldSize& field, int threads);

}  // namespace plotscan::methods::lattice
