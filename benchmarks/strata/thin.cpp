// SPDX-License-Identifier: Apache-2.0
#include "strata/thin.h"

#include <cmath>

#include "cloud/field_cloud.h"

#include "core/random.h"
#include "strata/position_file.h"

namespace plotscan::strata {

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
  std::vector<Eigen::Vector3f> points = read_positions(cloud);
  const double left = static_cast<double>(points.size()) * density_per_m2 / density;
  thin(points, static_cast<std::size_t>(std::llround(left)), points.size());
  std::filesystem::path thinned = cloud.parent_path() / "thinned.pcd";
  write_positions(thinned, points);
  return thinned;
}

}  // namespace plotscan::strata
