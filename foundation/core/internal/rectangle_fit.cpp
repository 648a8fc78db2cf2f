// SPDX-License-Identifier: Apache-2.0
#include "core/internal/rectangle_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

namespace plotscan {
namespace {

using Eigen::Vector2d;
using Ring = std::vector<Vector2d>;
using Corners = std::array<Vector2d, 4>;

constexpr std::size_t kMostVertices = 1000;

double distance_to_segment(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  const Vector2d along = to - from;
  const double length2 = along.squaredNorm();
  const double share =
      length2 > 0 ? std::clamp((point - from).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (from + share * along - point).norm();
}

double distance_to_outline(const Vector2d& point, const Corners& corners) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i)
    least_m = std::min(least_m, distance_to_segment(point, corners[i], corners[(i + 1) % 4]));
  return least_m;
}

// Drops the vertex that lies nearest to the line between its neighbours.
void drop_flattest(Ring& ring) {
  std::size_t flattest = 0;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double bend_m = distance_to_segment(ring[i], ring[(i + ring.size() - 1) % ring.size()],
                                              ring[(i + 1) % ring.size()]);
    if (bend_m >= least_m) continue;
    least_m = bend_m;
    flattest = i;
  }
  ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(flattest));
}

Vector2d turned_left(const Vector2d& vector) { return {-vector.y(), vector.x()}; }

// The rectangle whose corners are nearest to the given ones, in their order: its sides are the
// polygon's mean sides, each projected on the direction that keeps most of both.
Corners nearest_corners(const Ring& ring) {
  const Vector2d center = (ring[0] + ring[1] + ring[2] + ring[3]) / 4;
  const Vector2d side = (ring[1] - ring[0] + ring[2] - ring[3]) / 2;
  const Vector2d other = (ring[2] - ring[1] + ring[3] - ring[0]) / 2;
  const double turn = side.dot(turned_left(other)) > 0 ? -1 : 1;  // -1: clockwise
  const Vector2d other_turned = -turn * turned_left(other);
  const Eigen::Matrix2d moments = side * side.transpose() + other_turned * other_turned.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(moments);
  const Vector2d direction = solver.eigenvectors().col(1);
  const Vector2d half = direction * direction.dot(side) / 2;
  const Vector2d half_other = turn * turned_left(direction) * direction.dot(other_turned) / 2;
  return {center - half - half_other, center + half - half_other, center + half + half_other,
          center - half + half_other};
}

PlotBox box_of(const Corners& corners) {
  const Vector2d side = corners[1] - corners[0];
  const Vector2d other = corners[2] - corners[1];
  const bool side_is_length = side.norm() >= other.norm();
  const Vector2d length = side_is_length ? side : other;
  return {.center = (corners[0] + corners[2]) / 2,
          .width_m = (side_is_length ? other : side).norm(),
          .length_m = length.norm(),
          .heading_rad = wrap_heading(std::atan2(length.y(), length.x()))};
}

}  // namespace

std::optional<RectangleFit> fit_rectangle(Ring ring) {
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if (ring.size() < 4 || ring.size() > kMostVertices) return std::nullopt;
  const Vector2d origin = ring.front();  // squares of large map coordinates would lose digits
  for (Vector2d& vertex : ring) vertex -= origin;
  Ring kept = ring;
  while (kept.size() > 4) drop_flattest(kept);
  const Corners corners = nearest_corners(kept);
  RectangleFit fit{.box = box_of(corners)};
  for (std::size_t i = 0; i < 4; ++i)
    fit.off_m = std::max(fit.off_m, (kept[i] - corners[i]).norm());
  for (const Vector2d& vertex : ring)
    fit.off_m = std::max(fit.off_m, distance_to_outline(vertex, corners));
  fit.box.center += origin;
  return fit;
}

double rectangle_tolerance_m(const PlotBox& box) {
  const double diagonal_m = std::hypot(box.width_m, box.length_m);
  return std::min(std::max(0.1, 0.03 * diagonal_m), box.width_m / 4);
}

}  // namespace plotscan
