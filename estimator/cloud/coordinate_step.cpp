// SPDX-License-Identifier: Apache-2.0
#include "cloud/coordinate_step.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/list_of.h"

namespace plotscan::cloud {
namespace {

constexpr std::size_t kSample = std::size_t{1} << 16;
constexpr double kSame_m = 1e-3;    // what projections and units add to equal numbers
constexpr std::size_t kShared = 8;  // points that share a number on average: by chance few do

// Scattered over all numbers (the finaliser of SplitMix64; Steele, Lea and Flood, OOPSLA 2014):
// each n-th point of a raster would have coarser steps than the raster.
std::uint64_t scattered(std::uint64_t index) {
  index += 0x9e3779b97f4a7c15;
  index = (index ^ (index >> 30)) * 0xbf58476d1ce4e5b9;
  index = (index ^ (index >> 27)) * 0x94d049bb133111eb;
  return index ^ (index >> 31);
}

double step_of(std::vector<double> values_m) {
  std::ranges::sort(values_m);
  std::size_t numbers = 0;
  double step_m = 0;
  double last_m = 0;
  for (const double value_m : values_m) {
    if (numbers > 0 && value_m - last_m <= kSame_m) continue;
    const double gap_m = value_m - last_m;
    if (numbers > 0 && (step_m == 0 || gap_m < step_m)) step_m = gap_m;
    last_m = value_m;
    ++numbers;
  }
  return numbers * kShared <= values_m.size() ? step_m : 0;
}

}  // namespace

void CoordinateSteps::add(std::span<const Eigen::Vector3d> points) {
  for (const Eigen::Vector3d& point : points) {
    const std::uint64_t number = scattered(added_++);
    if (number > most_) continue;
    sample_.push_back({number, point.head<2>()});
    if (sample_.size() < kSample) continue;
    most_ /= 2;
    std::erase_if(sample_, [&](const Sampled& sampled) { return sampled.number > most_; });
  }
}

Eigen::Vector2d CoordinateSteps::steps_m() const {
  Eigen::Vector2d steps_m;
  for (const int axis : {0, 1}) {
    steps_m[axis] =
        step_of(list_of(sample_, [axis](const Sampled& sampled) { return sampled.place[axis]; }));
  }
  return steps_m;
}

std::string step_note(const Eigen::Vector2d& steps_m, double density_m2) {
  constexpr double kLeast_m = 0.05;  // profiles of plots are that fine
  constexpr double kSpacings = 1.5;
  const double most_m = steps_m.maxCoeff();
  if (most_m < std::max(kLeast_m, kSpacings / std::sqrt(std::max(density_m2, 1e-6)))) return "";
  return fmt::format(
      "{} counts in steps of {:.3g} m, wider than the points lie apart: digits were lost, as in "
      "floats of 4 bytes far from the origin; write the cloud with doubles, or nearer to its "
      "origin",
      steps_m.x() > steps_m.y() ? "x" : "y", most_m);
}

}  // namespace plotscan::cloud
