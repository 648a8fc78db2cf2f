// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>

#include "scan/point.h"

namespace plotscan::scan {

// Bytes of a LabelledPoint in a cloud.pcd (docs/scan-format.md), without padding.
inline constexpr std::size_t kPackedPointSize = 35;

// Writes the point's record to kPackedPointSize bytes at `record`; returns their end.
inline char* pack_point(const LabelledPoint& point, char* record) {
  const auto put = [&record](const auto& value) {
    std::memcpy(record, &value, sizeof value);
    record += sizeof value;
  };
  put(point.x);
  put(point.y);
  put(point.z);
  put(point.intensity);
  put(point.ring);
  put(point.time);
  put(point.label);
  put(point.plot);
  put(point.plant);
  return record;
}

// Streams labelled points to a binary PCD 0.7. The number of points is known only at the end: the
// header keeps a fixed length, and close() writes the number into it.
class PcdWriter {
 public:
  // Throws std::runtime_error when the file cannot be created.
  explicit PcdWriter(const std::filesystem::path& path);
  ~PcdWriter();
  PcdWriter(const PcdWriter&) = delete;
  PcdWriter& operator=(const PcdWriter&) = delete;

  // Appends whole records made by pack_point. Throws std::runtime_error when the disk is full.
  void write(std::span<const char> records);
  // Writes the number of points into the header. Without it the file says 0 points.
  void close();
  std::uint64_t points() const { return points_; }

 private:
  void write_bytes(std::span<const char> bytes);
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t points_ = 0;
};

}  // namespace plotscan::scan
