// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "scan/point.h"

namespace plotscan::scan {

// Bytes of a LabelledPoint in a cloud.pcd (docs/scan-format.md), without padding.
inline constexpr std::size_t kPackedPointSize = 37;

// Streams labelled points to a binary PCD 0.7. The number of points is known only at the end: the
// header keeps a fixed length, and close() writes the number into it.
class PcdWriter : public PointWriter {
 public:
  // Throws std::runtime_error when the file cannot be created.
  explicit PcdWriter(const std::filesystem::path& path);
  ~PcdWriter() override;
  PcdWriter(const PcdWriter&) = delete;
  PcdWriter& operator=(const PcdWriter&) = delete;

  // Throws std::runtime_error when the disk is full.
  void write(std::span<const LabelledPoint> points) override;
  // Writes what is buffered, and the number of points into the header. Without it the file says 0
  // points.
  void close() override;
  std::uint64_t points() const { return points_; }

 private:
  void flush();
  void write_bytes(std::span<const char> bytes);
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  int file_ = -1;
  std::vector<char> buffer_;
  std::size_t buffered_ = 0;  // bytes of buffer_ not written yet
  std::uint64_t points_ = 0;
};

}  // namespace plotscan::scan
