// SPDX-License-Identifier: Apache-2.0
#include "crop/internal/axis.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace plotscan::crop {

using Eigen::Vector3d;

Vector3d direction(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

void Axis::add(const Vector3d& step) {
  if (step.isZero(0)) return;
  points_.push_back(points_.back() + step);
  lengths_m_.push_back(lengths_m_.back() + step.norm());
}

std::size_t Axis::piece(double length_m) const {
  check(points_.size() >= 2, "an axis has two points or more");
  const auto after = std::upper_bound(lengths_m_.begin() + 1, lengths_m_.end() - 1, length_m);
  return static_cast<std::size_t>(after - lengths_m_.begin()) - 1;
}

Vector3d Axis::heading(double length_m) const {
  const std::size_t i = piece(length_m);
  return (points_[i + 1] - points_[i]).normalized();
}

Vector3d Axis::at(double length_m) const {
  return points_[piece(length_m)] + (length_m - lengths_m_[piece(length_m)]) * heading(length_m);
}

std::vector<Vector3d> Axis::part(double from_m, double to_m, int points) const {
  std::vector<Vector3d> path;
  path.reserve(static_cast<std::size_t>(points));
  for (int i = 0; i < points; ++i) path.push_back(at(from_m + (to_m - from_m) * i / (points - 1)));
  return path;
}

}  // namespace plotscan::crop
