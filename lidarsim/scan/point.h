// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>

namespace plotscan::scan {

// What a simulated point lies on. The numbers are those written to files.
enum class PointClass : std::uint8_t { unlabelled = 0, ground = 1, crop = 2, weed = 3, other = 4 };

// One return as written by the simulator: x, y, z, intensity, ring and time (the usual PointXYZIRT)
// in the world frame, the return's number among those of its shot, and labels.
struct LabelledPoint {
  float x = 0, y = 0, z = 0;       // world frame, metres
  float intensity = 0;             // 0..255
  std::uint16_t ring = 0;          // the laser's rank by elevation, 0 the lowest
  double time = 0;                 // of the shot, seconds from take-off
  std::uint8_t return_number = 1;  // from 1, the nearest, as LAS counts
  std::uint8_t return_count = 1;   // of the shot
  PointClass label = PointClass::unlabelled;
  std::uint32_t plot = 0;   // 0: none
  std::uint32_t plant = 0;  // 0: none

  bool operator==(const LabelledPoint&) const = default;
};

// Receives points piece by piece, in the order of firing, from one thread at a time.
using PointSink = std::function<void(std::span<const LabelledPoint>)>;

// A file that points are streamed to. Constructors and functions throw WriteError when it cannot be
// written.
class PointWriter {
 public:
  virtual ~PointWriter() = default;

  // Points in the order of firing.
  virtual void write(std::span<const LabelledPoint> points) = 0;
  // Finishes the file, which is incomplete without it.
  virtual void close() = 0;
};

}  // namespace plotscan::scan
