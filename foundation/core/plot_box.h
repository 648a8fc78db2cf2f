// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Core>

namespace plotscan {

// A plot's rectangle in the horizontal plane of the world frame (ENU, metres).
// heading_rad is the direction of the box's LENGTH axis, counter-clockwise from x (east); the WIDTH
// axis is 90 degrees counter-clockwise of it. A heading and the same plus pi mean the same box.
struct PlotBox {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double width_m = 0;
  double length_m = 0;
  double heading_rad = 0;

  Eigen::Vector2d length_axis() const;
  Eigen::Vector2d width_axis() const;
  double area_m2() const { return width_m * length_m; }
  // A world point in the box's frame: (along the length, along the width) from its centre, metres.
  Eigen::Vector2d box_from_world(const Eigen::Vector2d& world) const;
  bool contains(const Eigen::Vector2d& world) const;
  // In the world frame, counter-clockwise.
  std::array<Eigen::Vector2d, 4> corners() const;
};

// The area of the parallelogram that two vectors span: above 0 where `b` lies to the left of `a`.
inline double plane_cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Standard errors of a box along its own axes. They are independent of each other: in that frame
// the box's covariance matrix is diagonal.
struct PlotBoxError {
  double along_m = 0;   // of the centre, along the length
  double across_m = 0;  // of the centre, along the width
  double width_m = 0;
  double length_m = 0;
  double heading_rad = 0;
};

// The box with each of its ends end_m farther out.
PlotBox lengthened(PlotBox box, double end_m);

// Heading brought into [0, pi).
double wrap_heading(double heading_rad);
// Smallest angle between two box axes, in [0, pi / 2].
double heading_difference(double a_rad, double b_rad);

// Area of the intersection of two boxes (convex clipping, Sutherland-Hodgman), square metres.
double intersection_area(const PlotBox& a, const PlotBox& b);
// Intersection over union, in [0, 1]; 0 when both are empty.
double intersection_over_union(const PlotBox& a, const PlotBox& b);

}  // namespace plotscan
