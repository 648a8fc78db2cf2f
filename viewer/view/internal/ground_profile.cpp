// SPDX-License-Identifier: Apache-2.0
#include "view/internal/ground_profile.h"

#include <algorithm>
#include <cmath>

namespace plotscan::view {
namespace {

constexpr double kStep = 0.25;         // of the ground's grid
constexpr double kMostSteps = 20'000;  // however fine the grid: more than a picture has pixels

bool seen_at(const ground::Surface& ground, const Eigen::Vector2d& place) {
  const Eigen::Vector2d node = ((place - ground.origin) / ground.cell_m).array().round();
  const bool inside =
      node.x() >= 0 && node.y() >= 0 && node.x() < ground.columns && node.y() < ground.rows;
  return inside && ground.seen[static_cast<std::size_t>(node.y()) * ground.columns +
                               static_cast<std::size_t>(node.x())] != 0;
}

}  // namespace

std::vector<ProfilePoint> ground_profile(const ground::Surface& ground, const PlotBox& box,
                                         double beyond_m) {
  const double length_m = box.length_m + 2 * beyond_m;
  const int steps =
      static_cast<int>(std::ceil(std::clamp(length_m / (kStep * ground.cell_m), 1.0, kMostSteps)));
  std::vector<ProfilePoint> profile;
  for (int step = 0; step <= steps; ++step) {
    const double along_m = -beyond_m + length_m * step / steps;
    const Eigen::Vector2d place = box.center + (along_m - box.length_m / 2) * box.length_axis();
    profile.push_back({.along_m = along_m,
                       .z_m = ground.height(place),
                       .standard_error_m = ground.standard_error(place),
                       .seen = seen_at(ground, place)});
  }
  return profile;
}

std::vector<ProfileRun> runs_of(const std::vector<ProfilePoint>& profile, bool by_seen) {
  std::vector<ProfileRun> runs;
  std::size_t first = 0;
  while (first < profile.size()) {
    if (std::isnan(profile[first].z_m)) {
      ++first;
      continue;
    }
    std::size_t last = first;
    while (last + 1 < profile.size() && !std::isnan(profile[last + 1].z_m) &&
           (!by_seen || profile[last].seen == profile[first].seen))
      ++last;
    runs.push_back(ProfileRun(profile).subspan(first, last - first + 1));
    const bool turns = last + 1 < profile.size() && !std::isnan(profile[last + 1].z_m);
    first = turns ? last : last + 1;
  }
  return runs;
}

}  // namespace plotscan::view
