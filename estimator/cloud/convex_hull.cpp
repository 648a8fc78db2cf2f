// SPDX-License-Identifier: Apache-2.0
#include "cloud/convex_hull.h"

#include <algorithm>
#include <utility>

namespace plotscan::cloud {
namespace {

// Half of a hull: the points that turn left.
template <class Iterator>
void append_chain(Iterator first, Iterator last, std::vector<Eigen::Vector2d>& hull) {
  const std::size_t start = hull.size();
  for (; first != last; ++first) {
    while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *first) <= 0)
      hull.pop_back();
    hull.push_back(*first);
  }
  hull.pop_back();  // begins the other chain
}

}  // namespace

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  std::ranges::sort(points, {}, [](const Eigen::Vector2d& p) { return std::pair(p.x(), p.y()); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull;
  append_chain(points.begin(), points.end(), hull);
  append_chain(points.rbegin(), points.rend(), hull);
  return hull;
}

}  // namespace plotscan::cloud
