// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/internal/oriented_box.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plotscan::methods::dhami2020 {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool lexicographic(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
}

// Appends the chain of left turns through the points from `first` to `last`.
template <class Iterator>
void append_chain(Iterator first, Iterator last, std::vector<Eigen::Vector2d>& hull) {
  const std::size_t start = hull.size();
  for (; first != last; ++first) {
    while (hull.size() >= start + 2 &&
           cross(hull.back() - hull[hull.size() - 2], *first - hull.back()) <= 0) {
      hull.pop_back();
    }
    hull.push_back(*first);
  }
  hull.pop_back();  // the other chain begins with it
}

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
          .heading_rad =
              wrap_heading(side_is_length ? heading_rad : heading_rad + std::numbers::pi / 2)};
}

}  // namespace

std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), lexicographic);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull;
  append_chain(points.begin(), points.end(), hull);
  append_chain(points.rbegin(), points.rend(), hull);
  return hull;
}

PlotBox minimum_area_box(std::vector<Eigen::Vector2d> points) {
  const std::vector<Eigen::Vector2d> hull = convex_hull(std::move(points));
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
