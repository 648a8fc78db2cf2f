// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lidar/rays.h"
#include "sensor/sensor.h"

namespace plotscan::lidar {

inline constexpr int kMaxSubRays = 1024;

// `count` points of equal weight that stand for the standard normal distribution of the plane: a
// Fibonacci spiral and its reflection about the origin, with the origin itself where the count is
// odd. Their mean is exactly 0 and their covariance the unit matrix. Only a pair, with or without
// the origin, is too few for that covariance: it has just the right mean square distance, 2.
std::vector<Eigen::Vector2d> normal_pattern(int count);

// The sub-rays that stand for a beam, each with the same share of its energy (docs/beam.md).
class SubRays {
 public:
  // `count` is in [1, kMaxSubRays].
  SubRays(const sensor::Beam& beam, int count);

  std::size_t count() const { return count_; }
  // Writes the sub-rays of a shot along `axis` to [first, first + count()) of `rays`. The beam's
  // ellipse is aligned with the direction of the spin, axis x spin_axis; within it the pattern is
  // turned from shot to shot.
  void spread(const Ray& axis, const Eigen::Vector3f& spin_axis, std::uint64_t shot,
              RayArrays& rays, std::size_t first) const;

 private:
  using Lanes = Eigen::Array<float, 8, 1>;
  // Eight points of the pattern for vector instructions; in the last Points some may be unused.
  struct Points {
    Lanes x = Lanes::Zero(), y = Lanes::Zero();
  };

  std::size_t count_;
  std::vector<Points> pattern_;
  float along_rad_;  // standard deviations
  float across_rad_;
};

}  // namespace plotscan::lidar
