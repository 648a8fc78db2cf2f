// SPDX-License-Identifier: Apache-2.0
#include "strata/position_file.h"

#include <bit>
#include <fstream>
#include <string>

#include "core/error.h"
#include "scan/cloud_reader.h"

namespace plotscan::strata {

static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(Eigen::Vector3f) == 12);

void write_positions(const std::filesystem::path& file,
                     const std::vector<Eigen::Vector3f>& points) {
  const std::string count = std::to_string(points.size());
  std::ofstream out(file, std::ios::binary);
  out << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"
         "TYPE F F F\nCOUNT 1 1 1\nWIDTH "
      << count << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << count << "\nDATA binary\n";
  out.write(reinterpret_cast<const char*>(points.data()),
            static_cast<std::streamsize>(points.size() * sizeof(Eigen::Vector3f)));
  out.close();
  if (!out) throw WriteError(file);
}

std::vector<Eigen::Vector3f> read_positions(const std::filesystem::path& cloud) {
  std::vector<Eigen::Vector3f> points;
  scan::read_positions(cloud, [&](std::span<const Eigen::Vector3d> piece) {
    for (const Eigen::Vector3d& point : piece) points.push_back(point.cast<float>());
  });
  return points;
}

}  // namespace plotscan::strata
