// SPDX-License-Identifier: Apache-2.0
#pragma once

// LAS files as other programs write them, byte by byte after the tables of "LAS Specification 1.4 -
// R15" (ASPRS, 2019).

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "scan/cloud_reader.h"
#include "temporary_folder.h"

namespace plotscan::scan {

template <class T>
inline void put(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(&bytes[offset], &value, sizeof value);
}

struct ForeignPoint {
  std::array<std::int32_t, 3> xyz{};
  std::uint8_t classification = 0;
  bool withheld = false;
};

struct ForeignLas {
  int minor = 2;
  int format = 0;
  std::size_t extra_bytes = 0;  // behind each point, that no record describes
  std::array<double, 3> scale_m = {0.001, 0.001, 0.001};
  std::array<double, 3> offset_m = {};
  std::string records = {};  // variable length, in front of the points
  std::uint32_t record_count = 0;
  std::string extended_records = {};  // behind them
  std::uint32_t extended_record_count = 0;
};

// Tables 7 to 17: the sizes of the point formats.
inline constexpr std::array<std::size_t, 11> kSizes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

inline std::string bytes_of(const ForeignLas& las, const std::vector<ForeignPoint>& points) {
  const std::size_t header_size = las.minor >= 4 ? 375 : las.minor == 3 ? 235 : 227;
  const std::size_t points_at = header_size + las.records.size();
  const std::size_t format = static_cast<std::size_t>(las.format);
  const std::size_t point_size = kSizes[format] + las.extra_bytes;
  std::string bytes(header_size, '\0');
  std::memcpy(bytes.data(), "LASF", 4);
  put(bytes, 24, std::uint8_t{1});
  put(bytes, 25, static_cast<std::uint8_t>(las.minor));
  put(bytes, 94, static_cast<std::uint16_t>(header_size));
  put(bytes, 96, static_cast<std::uint32_t>(points_at));
  put(bytes, 100, las.record_count);
  put(bytes, 104, static_cast<std::uint8_t>(las.format));
  put(bytes, 105, static_cast<std::uint16_t>(point_size));
  // Formats 6 to 10 leave the old count 0.
  if (las.format < 6) put(bytes, 107, static_cast<std::uint32_t>(points.size()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(bytes, 131 + 8 * axis, las.scale_m[axis]);
    put(bytes, 155 + 8 * axis, las.offset_m[axis]);
  }
  if (las.minor >= 4) {
    put(bytes, 235, static_cast<std::uint64_t>(points_at + points.size() * point_size));
    put(bytes, 243, las.extended_record_count);
    put(bytes, 247, static_cast<std::uint64_t>(points.size()));
  }
  bytes += las.records;
  for (const ForeignPoint& point : points) {
    std::string record(point_size, '\x5a');  // fields that nobody should look at
    for (std::size_t axis = 0; axis < 3; ++axis) put(record, 4 * axis, point.xyz[axis]);
    const bool is_new = las.format >= 6;
    record[15] =
        static_cast<char>(is_new ? (point.withheld ? 0x0f : 0x0b)
                                 : point.classification | 0x60 | (point.withheld ? 0x80 : 0));
    if (is_new) record[16] = static_cast<char>(point.classification);
    bytes += record;
  }
  return bytes + las.extended_records;
}

inline std::string record(const std::string& user, std::uint16_t id, const std::string& data,
                          bool extended = false) {
  std::string bytes(extended ? 60 : 54, '\0');
  std::memcpy(&bytes[2], user.data(), user.size());
  put(bytes, 18, id);
  if (extended) {
    put(bytes, 20, static_cast<std::uint64_t>(data.size()));
  } else {
    put(bytes, 20, static_cast<std::uint16_t>(data.size()));
  }
  return bytes + data;
}

struct Read {
  CloudSummary summary;
  std::vector<Eigen::Vector3d> positions;
};

class ForeignLasFile : public ::testing::Test {
 protected:
  Read read(const std::string& bytes, bool leave_out_marked = false) const {
    Read result;
    result.summary = read_positions(folder_.write("cloud.las", bytes),
                                    [&](std::span<const Eigen::Vector3d> piece) {
                                      result.positions.insert(result.positions.end(), piece.begin(),
                                                              piece.end());
                                    },
                                    {.leave_out_marked = leave_out_marked});
    return result;
  }
  Read read(const ForeignLas& las, const std::vector<ForeignPoint>& points,
            bool leave_out_marked = false) const {
    return read(bytes_of(las, points), leave_out_marked);
  }

  testing::TemporaryFolder folder_;
};

}  // namespace plotscan::scan
