// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include <Eigen/Core>

#include "core/utc_time.h"
#include "scan/point.h"
#include "scan/record_file.h"

namespace plotscan::scan {

// What a LAS file states besides its points.
struct LasOptions {
  // The instant of the points' time 0: times are then written as adjusted standard GPS time.
  // Absent: times are written unchanged, as GPS week time.
  std::optional<UtcTime> start = {};
  std::string crs_wkt;           // the coordinate system (OGC 01-009), see las_crs.h
  std::string system = "OTHER";  // what made the points, "Velodyne VLP-16 (Puck)"
  // The offset of the file's coordinates. They are stored in steps of 0.1 mm, up to 214 km from it.
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
  // Returns the coordinates that the file gets for a point. Empty: offset_m + (x, y, z).
  std::function<Eigen::Vector3d(const LabelledPoint&)> coordinates = {};
  // Returns a point's scan angle from straight down, positive to the right of the flight. Empty: 0.
  std::function<double(const LabelledPoint&)> scan_angle_rad = {};
  // Whether to write the extra bytes plot, plant and class, and the standard class. If not, ring is
  // the only extra byte, and every point has class 0 (never classified).
  bool labels = true;
};

// Streams points to LAS 1.4, point format 6 with the extra bytes ring, plot, plant and class
// (docs/formats.md). Bounds and counts are written into the header by close().
class LasWriter : public PointWriter {
 public:
  LasWriter(const std::filesystem::path& path, LasOptions options);

  // Throws InputError on a point that is too far from the file's offset.
  void write(std::span<const LabelledPoint> points) override;
  void close() override;

 private:
  std::array<std::int32_t, 3> steps_of(const LabelledPoint& point) const;
  void pack(const LabelledPoint& point, char* record);
  std::string header() const;
  std::size_t record_size() const;

  std::filesystem::path path_;
  LasOptions options_;
  double gps_offset_s_ = 0;  // the file's times minus ours
  std::string records_;      // the variable length records
  std::uint64_t points_ = 0;
  std::array<std::uint64_t, 15> by_return_{};
  std::array<std::int32_t, 3> least_;
  std::array<std::int32_t, 3> most_;
  RecordFile file_;
};

}  // namespace plotscan::scan
