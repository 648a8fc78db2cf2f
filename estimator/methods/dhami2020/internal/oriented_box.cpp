// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/internal/oriented_box.h"

#include <cmath>
#include <limits>
#include <utility>

#include "cloud/convex_hull.h"
#include "core/angle.h"

namespace plotscan::methods::dhami2020 {
namespace {

// The box around the hull with one side in direction `heading_rad`.
PlotBox box_along(const std::vector<Eigen::Vector2d>& hull, double heading_rad) {
  const Eigen::Vector2d along(std::cos(heading_rad), std::sin(heading_rad));
  const Eigen::Vector2d across(-along.y(), along.x());
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high = -low;
  for (const Eigen::Vector2d& corner : hull) {
    const Eigen::Array2d local(along.dot(corner), across.dot(corner));
    low = low.min(local);
    high = high.max(local);
  }
  const Eigen::Array2d middle = (low + high) / 2;
  const Eigen::Array2d side = high - low;
  const bool side_is_length = side.x() >= side.y();
  return {.center = along * middle.x() + across * middle.y(),
          .width_m = side.minCoeff(),
          .length_m = side.maxCoeff(),
          .heading_rad = wrap_heading(side_is_length ? heading_rad : heading_rad + kPi / 2)};
}

}  // namespace

PlotBox minimum_area_box(std::vector<Eigen::Vector2d> points) {
  const std::vector<Eigen::Vector2d> hull = cloud::convex_hull(std::move(points));
  PlotBox best;
  double least_area = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    const PlotBox box = box_along(hull, std::atan2(edge.y(), edge.x()));
    if (box.area_m2() >= least_area) continue;
    least_area = box.area_m2();
    best = box;
  }
  return best;
}

}  // namespace plotscan::methods::dhami2020
