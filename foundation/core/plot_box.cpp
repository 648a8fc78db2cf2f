// SPDX-License-Identifier: Apache-2.0
#include "core/plot_box.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/angle.h"

namespace plotscan {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

// The part of the polygon to the left of the line from `a` to `b`.
Polygon clip_left_of(const Polygon& polygon, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& from = polygon[i];
    const Eigen::Vector2d& to = polygon[(i + 1) % polygon.size()];
    const double from_side = plane_cross(b - a, from - a);
    const double to_side = plane_cross(b - a, to - a);
    if (from_side >= 0) kept.push_back(from);
    if ((from_side >= 0) != (to_side >= 0))
      kept.emplace_back(from + (to - from) * (from_side / (from_side - to_side)));
  }
  return kept;
}

double area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += plane_cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twice / 2;
}

}  // namespace

Eigen::Vector2d PlotBox::length_axis() const {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}
Eigen::Vector2d PlotBox::width_axis() const {
  return {-std::sin(heading_rad), std::cos(heading_rad)};
}

Eigen::Vector2d PlotBox::box_from_world(const Eigen::Vector2d& world) const {
  const Eigen::Vector2d offset = world - center;
  return {offset.dot(length_axis()), offset.dot(width_axis())};
}

bool PlotBox::contains(const Eigen::Vector2d& world) const {
  const Eigen::Vector2d local = box_from_world(world);
  return std::abs(local.x()) <= length_m / 2 && std::abs(local.y()) <= width_m / 2;
}

std::array<Eigen::Vector2d, 4> PlotBox::corners() const {
  const Eigen::Vector2d l = length_axis() * (length_m / 2);
  const Eigen::Vector2d w = width_axis() * (width_m / 2);
  return {center - l - w, center + l - w, center + l + w, center - l + w};
}

PlotBox lengthened(PlotBox box, double end_m) {
  box.length_m += 2 * end_m;
  return box;
}

double wrap_heading(double heading_rad) {
  const double wrapped = std::fmod(heading_rad, kPi);
  const double positive = wrapped < 0 ? wrapped + kPi : wrapped;
  return positive >= kPi ? 0.0 : positive;
}

double heading_difference(double a_rad, double b_rad) {
  const double difference = wrap_heading(a_rad - b_rad);
  return std::min(difference, kPi - difference);
}

// Counted from the centre of `a`: products of UTM's millions would take the area's digits.
double intersection_area(const PlotBox& a, const PlotBox& b) {
  PlotBox centred = a;
  centred.center.setZero();
  PlotBox other = b;
  other.center -= a.center;
  const auto a_corners = centred.corners();
  Polygon polygon(a_corners.begin(), a_corners.end());
  const auto edges = other.corners();
  for (std::size_t i = 0; i < edges.size() && !polygon.empty(); ++i)
    polygon = clip_left_of(polygon, edges[i], edges[(i + 1) % edges.size()]);
  return area(polygon);
}

double intersection_over_union(const PlotBox& a, const PlotBox& b) {
  const double shared = intersection_area(a, b);
  const double joined = a.area_m2() + b.area_m2() - shared;
  return joined > 0 ? std::min(1.0, shared / joined) : 0.0;
}

}  // namespace plotscan
