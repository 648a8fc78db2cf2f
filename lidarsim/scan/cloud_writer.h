// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scan/point.h"
#include "scan/point_record.h"
#include "scan/record_file.h"

namespace plotscan::scan {

struct CloudWriteOptions {
  bool ascii = false;  // one point a line instead of binary records
  // A point lies at origin_m + (x, y, z). Where it is not zero, x, y and z are written as doubles.
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  bool labels = true;  // write class, plot and plant
};

// Streams labelled points to a file, one record or line per point. As the number of points is known
// only at the end, the header has a fixed length, and close() writes the number into it.
class CloudWriter : public PointWriter {
 public:
  void write(std::span<const LabelledPoint> points) override;
  // Writes what is buffered, and the number of points into the header. Without it the file says 0
  // points.
  void close() override;
  std::uint64_t points() const { return points_; }

 protected:
  using Header = std::string (*)(std::uint64_t points,
                                 const std::vector<PointRecord::Field>& fields, bool ascii);
  CloudWriter(const std::filesystem::path& path, const CloudWriteOptions& options, Header header);

 private:
  RecordFile file_;
  PointRecord record_;
  bool ascii_;
  Header header_;
  std::string text_;  // of the current points
  std::uint64_t points_ = 0;
};

// PCD 0.7, binary (docs/scan-format.md, cloud.pcd) or ascii.
class PcdWriter : public CloudWriter {
 public:
  explicit PcdWriter(const std::filesystem::path& path, const CloudWriteOptions& options = {});
};

// PLY 1.0, binary_little_endian or ascii: element vertex with the fields of cloud.pcd.
class PlyWriter : public CloudWriter {
 public:
  explicit PlyWriter(const std::filesystem::path& path, const CloudWriteOptions& options = {});
};

// PCD 0.7, binary_compressed. The format is one block of all x, then all y and so on, so the whole
// cloud is kept in memory: 74 bytes a point, and 37 more while it is compressed. As a block's size
// has 32 bits, it holds at most 116 million points (87 million with an origin).
class CompressedPcdWriter : public PointWriter {
 public:
  CompressedPcdWriter(const std::filesystem::path& path, const Eigen::Vector3d& origin_m,
                      bool labels = true);

  // Throws InputError when there are too many points.
  void write(std::span<const LabelledPoint> points) override;
  void close() override;

 private:
  std::filesystem::path path_;
  RecordFile file_;
  PointRecord record_;
  std::vector<char> records_;
};

}  // namespace plotscan::scan
