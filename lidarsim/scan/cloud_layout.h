// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: what a PCD or PLY header tells about the points that follow it.

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "scan/cloud_reader.h"

namespace plotscan::scan {

enum class CloudBody {
  ascii,       // one point a line
  binary,      // one record a point
  compressed,  // PCD: LZF over field after field
};

// Where x, y or z lies.
struct Coordinate {
  std::size_t column = 0;        // of an ascii line
  std::size_t offset = 0;        // in a binary record, bytes
  std::size_t element_size = 0;  // 4: float, 8: double
};

struct CloudLayout {
  CloudBody body = CloudBody::ascii;
  bool big_endian = false;
  std::uint64_t points = 0;
  std::size_t columns = 0;      // of an ascii line
  std::size_t record_size = 0;  // of a point, bytes
  std::array<Coordinate, 3> xyz;
  std::uint64_t body_offset = 0;  // of the first point, bytes from the file's start
  std::size_t body_line = 0;      // of the first point, lines from 1
};

// A cloud's file while its header is read: lines with their numbers, refusing what is no text.
class HeaderLines {
 public:
  explicit HeaderLines(const std::filesystem::path& file);

  // The next line's words; an empty line has none. InputError at the end of the file.
  const std::vector<std::string>& next();
  // Bytes before the line after the last one read.
  std::uint64_t offset() const { return offset_; }
  std::size_t line() const { return line_; }
  [[noreturn]] void fail(const std::string& what) const;
  // A word of the last line as a whole number in [low, high], or InputError.
  std::uint64_t whole_number(const std::string& word, std::uint64_t low, std::uint64_t high) const;

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::size_t line_ = 0;
  std::uint64_t offset_ = 0;
  std::vector<std::string> words_;
};

// The most bytes one point may have: ample for descriptors of a thousand numbers.
inline constexpr std::size_t kMaxRecordSize = std::size_t{1} << 16;
// The most points a file may promise, so that sizes in bytes never overflow.
inline constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 40;

CloudLayout read_pcd_header(const std::filesystem::path& file);
CloudLayout read_ply_header(const std::filesystem::path& file);

// Hands on the points that the layout describes.
CloudSummary read_body(const std::filesystem::path& file, const CloudLayout& layout,
                       const PositionSink& sink);

}  // namespace plotscan::scan
