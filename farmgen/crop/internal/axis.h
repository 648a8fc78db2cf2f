// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace plotscan::crop {

// The unit vector at an azimuth (counter-clockwise from x) and an elevation over the horizontal.
Eigen::Vector3d direction(double azimuth_rad, double elevation_rad);

// A stem's course: a polyline that is found by the length along it from its foot, metres.
class Axis {
 public:
  explicit Axis(const Eigen::Vector3d& foot) : points_{foot}, lengths_m_{0} {}

  void add(const Eigen::Vector3d& step);

  double length_m() const { return lengths_m_.back(); }
  // Lengths beyond the ends continue the first and last piece.
  Eigen::Vector3d at(double length_m) const;
  Eigen::Vector3d heading(double length_m) const;  // of length 1, towards the tip
  // Evenly spaced points between two lengths, both included.
  std::vector<Eigen::Vector3d> part(double from_m, double to_m, int points) const;

 private:
  std::size_t piece(double length_m) const;  // index of the point that begins it

  std::vector<Eigen::Vector3d> points_;
  std::vector<double> lengths_m_;
};

}  // namespace plotscan::crop
