// SPDX-License-Identifier: Apache-2.0
#include "strata/thinned_cloud.h"

#include <bit>
#include <cmath>
#include <fstream>
#include <string>

#include "cloud/field_cloud.h"
#include "core/error.h"
#include "core/random.h"
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

void thin(std::vector<Eigen::Vector3f>& points, std::size_t most, std::uint64_t seed) {
  if (points.size() <= most) return;
  RandomStream random(seed, random_purpose("strata/thin"), 0);
  std::size_t left = points.size();
  std::size_t wanted = most;
  std::erase_if(points, [&](const Eigen::Vector3f&) {
    const bool kept = random.below(left--) < wanted;
    wanted -= kept;
    return !kept;
  });
}

std::filesystem::path thinned_cloud(const std::filesystem::path& cloud, double density_per_m2,
                                    int threads) {
  const double density = cloud::read_field({{cloud}}, {.threads = threads}).density_m2;
  if (density <= density_per_m2) return cloud;
  std::vector<Eigen::Vector3f> points = scan::read_positions(cloud);
  const double left = static_cast<double>(points.size()) * density_per_m2 / density;
  thin(points, static_cast<std::size_t>(std::llround(left)), points.size());
  std::filesystem::path thinned = cloud.parent_path() / "thinned.pcd";
  write_positions(thinned, points);
  return thinned;
}

}  // namespace plotscan::strata
