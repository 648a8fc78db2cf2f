// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/internal/ground_level.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Dense>

#include "core/packed_pair.h"

namespace plotscan::methods::dhami2020 {
namespace {

constexpr double kCell_m = 1.0;
constexpr int kIterations = 50;
constexpr int kCenteringRounds = 5;
constexpr double kGroundBand_m = 0.15;  // about the level: points that may be ground
// Residuals below it count as equally good; below the range noise, so that it decides nothing.
constexpr double kSmallResidual_m = 0.005;

std::vector<Eigen::Vector3d> lowest_by_cell(std::span<const Eigen::Vector3f> points) {
  std::unordered_map<std::uint64_t, std::size_t> cell_index;
  std::vector<Eigen::Vector3d> lowest;
  for (const Eigen::Vector3f& point : points) {
    const auto x = static_cast<std::int32_t>(std::floor(point.x() / kCell_m));
    const auto y = static_cast<std::int32_t>(std::floor(point.y() / kCell_m));
    const auto [found, is_new] = cell_index.emplace(packed_pair(x, y), lowest.size());
    if (is_new) {
      lowest.emplace_back(point.cast<double>());
    } else if (point.z() < lowest[found->second].z()) {
      lowest[found->second] = point.cast<double>();
    }
  }
  return lowest;
}

// Least absolute deviations by iteratively reweighted least squares.
GroundLevel fit_plane(const std::vector<Eigen::Vector3d>& lowest) {
  std::vector<double> weights(lowest.size(), 1.0);
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    // A trace of ridge holds the slope at zero where the cells don't determine it.
    Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < lowest.size(); ++i) {
      const Eigen::Vector3d row(1, lowest[i].x(), lowest[i].y());
      normal += weights[i] * row * row.transpose();
      right += weights[i] * lowest[i].z() * row;
    }
    plane = normal.ldlt().solve(right);
    for (std::size_t i = 0; i < lowest.size(); ++i) {
      const double residual =
          lowest[i].z() - plane.dot(Eigen::Vector3d(1, lowest[i].x(), lowest[i].y()));
      weights[i] = 1 / std::max(std::abs(residual), kSmallResidual_m);
    }
  }
  return {.offset_m = plane.x(), .slope = plane.tail<2>()};
}

// Lowest points lie below the ground by some deviations of the range noise: raises the level to the
// mean of the points about it.
void center_on_ground(std::span<const Eigen::Vector3f> points, GroundLevel& level) {
  for (int round = 0; round < kCenteringRounds; ++round) {
    double sum_m = 0;
    std::size_t count = 0;
    for (const Eigen::Vector3f& point : points) {
      const double height_m = level.height_of(point);
      if (std::abs(height_m) > kGroundBand_m) continue;
      sum_m += height_m;
      ++count;
    }
    if (count == 0) return;
    level.offset_m += sum_m / static_cast<double>(count);
  }
}

}  // namespace

GroundLevel fit_ground_level(std::span<const Eigen::Vector3f> points) {
  GroundLevel level = fit_plane(lowest_by_cell(points));
  center_on_ground(points, level);
  return level;
}

}  // namespace plotscan::methods::dhami2020
