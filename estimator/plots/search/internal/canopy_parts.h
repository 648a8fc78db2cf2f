// SPDX-License-Identifier: Apache-2.0
#pragma once

// The parts of a field's canopy that lie apart from each other.

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plotscan::plots {

// What stands on a field, in parts with wide gaps between them, as paths between trials are. On
// cells of 0.25 m, wider on fields of over a square kilometre.
class CanopyParts {
 public:
  // Points: x, y, height above the ground, metres. Canopy is what is higher than low_m; what lies
  // within gap_m of each other is of one part.
  CanopyParts(std::span<const Eigen::Vector3f> points, double low_m, double gap_m);

  // How many there are, but for small ones, which may be weeds.
  std::size_t size() const { return size_; }
  // The finite points of the field in and about a part, but for those in, or right beside, others.
  std::vector<Eigen::Vector3f> without_others(std::span<const Eigen::Vector3f> points,
                                              std::size_t part) const;

 private:
  Eigen::Index cell_of(const Eigen::Vector3f& point) const;
  void number_parts(const Eigen::ArrayXXi& returns, const Eigen::ArrayXXi& high, double gap_m);

  Eigen::AlignedBox2f extent_;
  float cell_m_ = 0;
  Eigen::ArrayXXi part_;  // by cell, from 1; 0 of none
  std::size_t size_ = 0;
};

}  // namespace plotscan::plots
